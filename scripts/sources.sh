# Sourced: lists the project's own C++ files.

# source_files NAME_PATTERN...: as find's -name takes them; nothing from build folders.
source_files() {
  local patterns=(-name "$1")
  shift
  local pattern
  for pattern in "$@"; do patterns+=(-o -name "$pattern"); done
  find . \( -path ./build -o -path ./results -o -path ./.git \) -prune -o -type f \( "${patterns[@]}" \) -print | sort
}
