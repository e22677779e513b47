// Which work group this is. A dispatch may have more of them than asked for, since one way alone has room for 65535:
// a shader leaves out what lies beyond its rows.
uint group_index() {
  return gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x;
}
