#include "frame/patch_injection.hpp"

#include "frame/device_lists.hpp"

#include <array>
#include <epoxy/gl.h>

namespace radiosity {
namespace {

constexpr unsigned triangles_of_sums_binding = 0;
constexpr unsigned written_sums_binding = 1;
constexpr unsigned read_sums_binding = 0;
constexpr unsigned injected_reflectance_binding = 1;
constexpr unsigned injected_own_binding = 2;
constexpr unsigned injected_emission_binding = 3;
constexpr unsigned areas_binding = 4;
constexpr Index invocations_of_injection_group = 64;

std::vector<ShaderVariant> injection_stages(int layers) {
  return {{"shadow.vert", {}}, {"injection.geom", {{"LAYERS", layers}}}, {"injection.frag", {}}};
}

/// The corners of all triangles, and the patch that each triangle is part of.
struct PatchTriangles {
  std::vector<float> corners;
  std::vector<std::uint32_t> patches;
};

PatchTriangles triangles_of_patches(const PatchMesh& mesh, const Vector3& origin) {
  PatchTriangles triangles;
  for (Index i = 0; i < mesh.patch_count(); ++i)
    for (int k = 2; k < mesh.patches[static_cast<std::size_t>(i)].corner_count; ++k) {
      triangles.patches.push_back(static_cast<std::uint32_t>(i));
      for (const int at : {0, k - 1, k})
        for (int axis = 0; axis < 3; ++axis)
          triangles.corners.push_back(static_cast<float>(mesh.corner(i, at)[axis] - origin[axis]));
    }
  return triangles;
}

void make_layers(const GlName& texture, GLenum format) {
  glBindTexture(GL_TEXTURE_2D_ARRAY, texture.get());
  glTexStorage3D(GL_TEXTURE_2D_ARRAY, 1, format, PatchInjection::face_pixels, PatchInjection::face_pixels,
                 cube_layers);
  glTexParameteri(GL_TEXTURE_2D_ARRAY, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
  glTexParameteri(GL_TEXTURE_2D_ARRAY, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
}

}  // namespace

PatchInjection::PatchInjection(const std::shared_ptr<GlDevice>& device, const PatchMesh& mesh,
                               const std::vector<FrameLightKind>& lights, const Vector3& origin)
    : kinds_(lights),
      patches_(mesh.patch_count()),
      corners_(static_cast<int>(3 * triangles_of_patches(mesh, origin).patches.size())),
      cube_program_(device->context(), injection_stages(cube_layers)),
      spot_program_(device->context(), injection_stages(1)),
      sums_program_(&device->program({"injection_sums.comp", {}})),
      emission_program_(&device->program({"injection_emission.comp", {}})),
      positions_(device_list(device->context(), triangles_of_patches(mesh, origin).corners)),
      patch_of_triangle_(device_list(device->context(), triangles_of_patches(mesh, origin).patches)),
      sums_(device_list(device->context(), std::vector<std::uint32_t>(
                                               most_frame_lights * static_cast<std::size_t>(patches_), 0))),
      reflectance_(device_columns(device->context(), in_three_columns(mesh.reflectance))),
      own_(device_columns(device->context(), in_three_columns(mesh.emission))),
      areas_(device_columns(device->context(), mesh.area)),
      vertices_(device->context(), glGenVertexArrays, glDeleteVertexArrays),
      triangles_(device->context(), glGenTextures, glDeleteTextures),
      depth_(device->context(), glGenTextures, glDeleteTextures),
      framebuffer_(device->context(), glGenFramebuffers, glDeleteFramebuffers) {
  glBindVertexArray(vertices_.get());
  glBindBuffer(GL_ARRAY_BUFFER, positions_.name());
  glEnableVertexAttribArray(0);
  glVertexAttribPointer(0, 3, GL_FLOAT, GL_FALSE, 0, nullptr);
  glBindVertexArray(0);
  glActiveTexture(GL_TEXTURE1);
  make_layers(depth_, GL_DEPTH_COMPONENT32F);
  make_layers(triangles_, GL_R32UI);
  glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_.get());
  glFramebufferTexture(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, depth_.get(), 0);
  glFramebufferTexture(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, triangles_.get(), 0);
  device->context()->check("making room for pictures around lights");
}

void PatchInjection::compute(const ResidentTransport& transport) const {
  for (std::size_t light = 0; light < kinds_.size(); ++light) {
    draw_around(light);
    sum_up(light);
  }
  glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
  sums_.bind(read_sums_binding);
  reflectance_.bind(injected_reflectance_binding);
  own_.bind(injected_own_binding);
  transport.emission().buffer().bind(injected_emission_binding);
  areas_.bind(areas_binding);
  emission_program_->use();
  emission_program_->set("patches", patches_);
  emission_program_->set("stride", transport.emission().stride());
  emission_program_->dispatch((patches_ + invocations_of_injection_group - 1) /
                              invocations_of_injection_group);
}

void PatchInjection::draw_around(std::size_t light) const {
  constexpr std::array<GLuint, 4> nothing = {0, 0, 0, 0};
  glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_.get());
  glViewport(0, 0, face_pixels, face_pixels);
  glEnable(GL_DEPTH_TEST);
  glDisable(GL_CULL_FACE);
  glClear(GL_DEPTH_BUFFER_BIT);
  glClearBufferuiv(GL_COLOR, 0, nothing.data());
  glBindVertexArray(vertices_.get());
  const GlProgram& program = kinds_[light] == FrameLightKind::point ? cube_program_ : spot_program_;
  program.use();
  program.set("light", static_cast<std::int64_t>(light));
  glDrawArrays(GL_TRIANGLES, 0, corners_);
}

void PatchInjection::sum_up(std::size_t light) const {
  const Index layers = layers_of(kinds_[light]);
  glActiveTexture(GL_TEXTURE1);
  glBindTexture(GL_TEXTURE_2D_ARRAY, triangles_.get());
  patch_of_triangle_.bind(triangles_of_sums_binding);
  sums_.bind(written_sums_binding);
  sums_program_->use();
  sums_program_->set("light", static_cast<std::int64_t>(light));
  sums_program_->set("layers", layers);
  sums_program_->set("size", face_pixels);
  sums_program_->set("patches", patches_);
  sums_program_->dispatch(layers * face_pixels * face_pixels / invocations_of_injection_group);
}

}  // namespace radiosity
