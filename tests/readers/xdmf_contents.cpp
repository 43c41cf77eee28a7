/// @file Prints what libxdmf, the library behind ParaView's Xdmf3 reader, finds in an XDMF index: for every
/// grid its name, time, numbers of triangles and points, and then x, y, ux, uy, uz of every point. A program
/// of its own, because libxdmf brings its own HDF5.   Usage: xdmf-contents INDEX

#include <XdmfAttribute.hpp>
#include <XdmfDomain.hpp>
#include <XdmfGeometry.hpp>
#include <XdmfGridCollection.hpp>
#include <XdmfReader.hpp>
#include <XdmfTime.hpp>
#include <XdmfTopology.hpp>
#include <XdmfUnstructuredGrid.hpp>
#include <cstdio>
#include <exception>

namespace {

void print(XdmfUnstructuredGrid& grid) {
  const auto geometry = grid.getGeometry();
  const auto displacement = grid.getAttribute("displacement");
  geometry->read();
  displacement->read();
  const unsigned points = geometry->getNumberPoints();
  std::printf("%s %g %u %u\n", grid.getName().c_str(), grid.getTime()->getValue(),
              grid.getTopology()->getNumberElements(), points);
  for (unsigned i = 0; i < points; ++i)
    std::printf("%.17g,%.17g,%.17g,%.17g,%.17g\n", geometry->getValue<double>(2 * i),
                geometry->getValue<double>(2 * i + 1), displacement->getValue<double>(3 * i),
                displacement->getValue<double>(3 * i + 1), displacement->getValue<double>(3 * i + 2));
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) return 2;
  try {
    const auto domain = shared_dynamic_cast<XdmfDomain>(XdmfReader::New()->read(argv[1]));
    const auto grids = domain->getGridCollection(0);
    for (unsigned i = 0; i < grids->getNumberUnstructuredGrids(); ++i) print(*grids->getUnstructuredGrid(i));
  } catch (const std::exception& error) {
    std::fprintf(stderr, "xdmf-contents: %s\n", error.what());
    return 1;
  }
}
