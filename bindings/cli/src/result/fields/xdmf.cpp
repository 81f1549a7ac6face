// SPDX-License-Identifier: BSD-3-Clause
#include "result/fields/xdmf.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "text/xml_text.hpp"

namespace cli {

namespace {

std::string item(const std::string& dimensions, bool real, const std::string& path, int bytes = 8) {
    return fmt::format(
        "<DataItem Format=\"HDF\" NumberType=\"{}\" Precision=\"{}\" Dimensions=\"{}\">fields.h5:{}</DataItem>",
        real ? "Float" : "Int", bytes, dimensions, path);
}

std::string attribute(const std::string& name, const char* type, const char* centre, std::int64_t rows,
                      std::int64_t columns, const std::string& path) {
    const std::string dimensions = columns > 1 ? fmt::format("{} {}", rows, columns) : fmt::format("{}", rows);
    return fmt::format("          <Attribute Name=\"{}\" AttributeType=\"{}\" Center=\"{}\">{}</Attribute>\n", name,
                       type, centre, item(dimensions, true, path));
}

std::string mesh(const XdmfBlock& block, const std::string& points, const std::string& cells,
                 const std::string& mixed = "") {
    // Lines need their number of nodes; ParaView wants it beside the number of elements.
    const std::string nodes_per_element =
        block.topology == "Polyline" ? fmt::format(" NodesPerElement=\"{}\"", block.points_per_cell) : "";
    return fmt::format(
        "          <Topology TopologyType=\"{}\" NumberOfElements=\"{}\"{}>{}</Topology>\n"
        "          <Geometry GeometryType=\"XYZ\">{}</Geometry>\n",
        block.topology, block.cells, nodes_per_element,
        block.entries > 0 ? item(fmt::format("{}", block.entries), false, mixed)
                          : item(fmt::format("{} {}", block.cells, block.points_per_cell), false, cells),
        item(fmt::format("{} 3", block.points), true, points));
}

}  // namespace

std::string xdmf_text(const std::vector<XdmfBlock>& blocks, const std::vector<XdmfStep>& steps,
                      const std::vector<std::string>& fields) {
    const auto has = [&fields](const char* name) {
        return std::find(fields.begin(), fields.end(), name) != fields.end();
    };
    std::string out =
        "<?xml version=\"1.0\" encoding=\"utf-8\"?>\n<Xdmf Version=\"3.0\">\n  <Domain>\n"
        "    <Grid Name=\"delam\" GridType=\"Collection\" CollectionType=\"Temporal\">\n";
    for (const XdmfStep& step : steps) {
        const std::string base = "/steps/" + step.group;
        out += fmt::format(
            "      <Grid Name=\"step {}\" GridType=\"Collection\" CollectionType=\"Spatial\">\n"
            "        <Time Value=\"{:.17g}\"/>\n",
            step.group, step.time);
        for (std::size_t i = 0; i < blocks.size(); ++i) {
            const XdmfBlock& block = blocks[i];
            out += fmt::format("        <Grid Name=\"{}\" GridType=\"Uniform\">\n", xml_text(block.name));
            if (i == 0) {
                out += mesh(block, "/mesh/points", "/mesh/cells", "/mesh/mixed");
                out += fmt::format(
                    "          <Attribute Name=\"body\" AttributeType=\"Scalar\" Center=\"Cell\">{}</Attribute>\n",
                    item(fmt::format("{}", block.cells), false, "/mesh/body", 4));
                if (has("displacement"))
                    out += attribute("displacement", "Vector", "Node", block.points, 3, base + "/displacement");
                if (has("rotation")) out += attribute("rotation", "Vector", "Cell", block.cells, 3, base + "/rotation");
                if (has("stress")) out += attribute("stress", "Matrix", "Cell", block.cells, 6, base + "/stress");
            } else {
                const std::string name = fmt::format("/interface_{}", i - 1);
                out += mesh(block, "/interfaces" + name + "/points", "/interfaces" + name + "/faces");
                for (const char* field : {"displacement", "jump", "traction"})
                    if (has(field))
                        out += attribute(field, "Vector", "Node", block.points, 3, base + name + "/" + field);
                for (const char* field : {"zeta", "contact", "mixity"})
                    if (has(field))
                        out += attribute(field, "Scalar", "Node", block.points, 1, base + name + "/" + field);
            }
            out += "        </Grid>\n";
        }
        out += "      </Grid>\n";
    }
    return out + "    </Grid>\n  </Domain>\n</Xdmf>\n";
}

}  // namespace cli
