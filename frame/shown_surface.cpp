#include "frame/shown_surface.hpp"

#include "frame/device_lists.hpp"
#include "frame/emission_points.hpp"

#include <algorithm>
#include <epoxy/gl.h>

namespace radiosity {
namespace {

constexpr unsigned begin_binding = 0;
constexpr unsigned gathered_binding = 1;
constexpr unsigned weights_binding_of_gather = 2;
constexpr unsigned gathered_irradiance_binding = 3;
constexpr unsigned vertex_light_binding = 4;
constexpr unsigned triangles_binding = 0;
constexpr unsigned surfaces_binding = 1;
constexpr Index vertices_of_gather_group = 64;

std::vector<float> position_list(const FrameMesh& mesh, const Vector3& origin) {
  const Eigen::Matrix3Xf list = (mesh.position.colwise() - origin).cast<float>();
  return {list.data(), list.data() + list.size()};
}

std::vector<std::uint32_t> index_list(const FrameMesh& mesh) {
  std::vector<std::uint32_t> list;
  list.reserve(3 * mesh.triangles.size());
  for (const auto& triangle : mesh.triangles) list.insert(list.end(), triangle.begin(), triangle.end());
  return list;
}

/// Normal, reflectance and emission of each patch, four numbers each.
std::vector<float> surface_list(const PatchMesh& mesh) {
  Eigen::MatrixXf list = Eigen::MatrixXf::Zero(12, mesh.patch_count());
  list.topRows<3>() = mesh.normal.cast<float>();
  list.middleRows<3>(4) = in_three_columns(mesh.reflectance).transpose().cast<float>();
  list.middleRows<3>(8) = in_three_columns(mesh.emission).transpose().cast<float>();
  return {list.data(), list.data() + list.size()};
}

std::vector<ShaderVariant> drawing_stages() {
  return {{"frame.vert", {}}, {"frame.frag", {}}};
}

}  // namespace

ShownSurface::ShownSurface(const std::shared_ptr<GlDevice>& device, const FrameMesh& mesh,
                           const PatchMesh& shown, const Vector3& origin)
    : vertex_count_(mesh.position.cols()),
      index_count_(static_cast<int>(3 * mesh.triangles.size())),
      positions_(device_list(device->context(), position_list(mesh, origin))),
      indices_(device_list(device->context(), index_list(mesh))),
      light_(
          device_list(device->context(), std::vector<float>(4 * static_cast<std::size_t>(vertex_count_), 0))),
      gather_begin_(device_list(device->context(), mesh.gather_begin)),
      gather_patch_(device_list(device->context(), mesh.gather_patch)),
      gather_weight_(device_list(device->context(), mesh.gather_weight)),
      patch_of_triangle_(device_list(device->context(), mesh.patch_of_triangle)),
      surfaces_(device_list(device->context(), surface_list(shown))),
      vertices_(device->context(), glGenVertexArrays, glDeleteVertexArrays),
      gather_program_(&device->program({"vertex_light.comp", {}})),
      draw_program_(device->context(), drawing_stages()) {
  glBindVertexArray(vertices_.get());
  glBindBuffer(GL_ARRAY_BUFFER, positions_.name());
  glEnableVertexAttribArray(0);
  glVertexAttribPointer(0, 3, GL_FLOAT, GL_FALSE, 0, nullptr);
  glBindBuffer(GL_ARRAY_BUFFER, light_.name());
  glEnableVertexAttribArray(1);
  glVertexAttribPointer(1, 4, GL_FLOAT, GL_FALSE, 0, nullptr);
  glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, indices_.name());
  glBindVertexArray(0);
  device->context()->check("sending what a frame shows");
}

void ShownSurface::gather(const ResidentTransport& transport) const {
  if (vertex_count_ == 0) return;
  gather_begin_.bind(begin_binding);
  gather_patch_.bind(gathered_binding);
  gather_weight_.bind(weights_binding_of_gather);
  transport.irradiance().buffer().bind(gathered_irradiance_binding);
  light_.bind(vertex_light_binding);
  gather_program_->use();
  gather_program_->set("vertex_count", vertex_count_);
  gather_program_->set("stride", transport.irradiance().stride());
  gather_program_->dispatch((vertex_count_ + vertices_of_gather_group - 1) / vertices_of_gather_group);
}

void ShownSurface::draw() const {
  patch_of_triangle_.bind(triangles_binding);
  surfaces_.bind(surfaces_binding);
  draw_program_.use();
  glBindVertexArray(vertices_.get());
  glDrawElements(GL_TRIANGLES, index_count_, GL_UNSIGNED_INT, nullptr);
}

}  // namespace radiosity
