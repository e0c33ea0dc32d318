# Installs the package into a virtual environment by pip, and with everything else into a prefix, and
# renders with each: by the modules and the data that lie there.
#   cmake -D PYTHON=<python3> -D BUILD=<build> -D SOURCE=<src/python> -D WORK=<scratch> -P wheel.cmake
include(${CMAKE_CURRENT_LIST_DIR}/../consumer/run_command.cmake)

file(REMOVE_RECURSE ${WORK})
execute_process(COMMAND ${PYTHON} -c "import ensurepip, venv" RESULT_VARIABLE lacks OUTPUT_QUIET ERROR_QUIET)
if(lacks)
  message("skipped: python3-venv was not found")
  return()
endif()
file(WRITE ${WORK}/use.py [[
import pathlib, sys
import quadrel
isa, root = sys.argv[1], pathlib.Path(sys.argv[2]).resolve()
assert root in pathlib.Path(quadrel.__file__).resolve().parents, quadrel.__file__
scene = quadrel.load("bricks-45", size=(32, 32))
assert root in pathlib.Path(scene.file).resolve().parents, scene.file
film = quadrel.render(scene, ["R", "N"], isa=isa)
assert film["R"].max() > 0
package = pathlib.Path(quadrel.__file__).parent
assert (package / "py.typed").exists() and (package / "_quadrel.pyi").exists()
maps = pathlib.Path("/proc/self/maps").read_text().splitlines()
kernels = {line.split()[-1] for line in maps if f"quadrel-kernels-{isa}.so" in line}
assert kernels and all(root in pathlib.Path(file).parents for file in kernels), kernels
]])
file(GLOB kernels RELATIVE ${BUILD}/modules ${BUILD}/modules/quadrel-kernels-*.so)
list(TRANSFORM kernels REPLACE "quadrel-kernels-(.*)\\.so" "\\1")
list(GET kernels 0 isa)

set(pip ${WORK}/env/bin/pip --disable-pip-version-check)
run(${PYTHON} -m venv --system-site-packages ${WORK}/env)
run(${CMAKE_COMMAND} -E env QUADREL_BUILD=${BUILD} PYTHONDONTWRITEBYTECODE=1
    ${pip} install --no-build-isolation --no-index ${SOURCE})
run(${WORK}/env/bin/python ${WORK}/use.py ${isa} ${WORK}/env)
run(${pip} uninstall -y quadrel)

run(${CMAKE_COMMAND} --install ${BUILD} --prefix ${WORK}/prefix)
file(GLOB packages ${WORK}/prefix/lib/python*/dist-packages)
run(${CMAKE_COMMAND} -E env PYTHONPATH=${packages} ${PYTHON} ${WORK}/use.py ${isa} ${WORK}/prefix)
