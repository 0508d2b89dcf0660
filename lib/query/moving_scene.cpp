// From positions to a step.
#include <query/moving_scene.h>

#include <chunks.h>
#include <cluster/frame.h>
#include <cluster/make_clusters.h>
#include <query/refit_cluster.h>
#include <tree/make_tree.h>

namespace pierce::detail {

namespace {

bool none_is_left_out(const Corners&) { return false; }

// Scene units; 1 where there are none that fit.
template <class Scalar>
double unit_or_one(const QuadBox<Scalar>& box, bool& fits) {
    fits = !is_empty(box) && largest_of<Scalar>(box.high * Scalar(0.5) - box.low * Scalar(0.5)) > 0;
    try {
        if (fits) return static_cast<double>(scene_unit(box));
    } catch (const MeshError&) {
        fits = false;
    }
    return 1;
}

template <class Scalar>
QuadBox<Scalar> box_of_all(const TreeShape& shape, const TreeBoxes<Scalar>& boxes) {
    if (!shape.nodes.empty()) return boxes.nodes[0];
    QuadBox<Scalar> all;
    for (const ClusterBox<Scalar>& box : boxes.clusters) all.add(box_of<Scalar>(box));
    return all;
}

}  // namespace

template <class Scalar>
std::shared_ptr<const MovingLayout<Scalar>> make_layout(const PlainMesh<Scalar>& mesh, const Executor& executor) {
    auto layout = std::make_shared<MovingLayout<Scalar>>();
    ClusterBuild<Scalar> built = make_clusters(mesh, none_is_left_out, executor);
    layout->empty = built.clusters.empty;
    layout->numbers.resize(mesh.triangles.size());
    std::vector<ClusterRef> refs;
    for (const ClusterBox<Scalar>& box : built.boxes) {
        refs.push_back(box.ref);
        for (std::uint32_t lane = 0; lane < count_of(box.ref); ++lane)
            layout->numbers[first_of(box.ref) + lane] = built.clusters.triangle(box.ref, lane);
    }
    if (!refs.empty())
        layout->tree = make_tree(std::span(built.boxes.data(), built.boxes.size()), built.clusters.empty,
                                 frame_of(built), executor);
    layout->shape = shape_of(layout->tree, refs, layout->empty);
    MovingRecords<Scalar> records;
    write_records<Scalar>(layout, mesh, records, executor);
    TreeBoxes<Scalar> boxes(layout->shape);
    layout->cost = 1;
    layout->cost = layout_cost(records, boxes);
    return layout;
}

template <class Scalar>
void write_records(const std::shared_ptr<const MovingLayout<Scalar>>& layout, const PlainMesh<Scalar>& mesh,
                   MovingRecords<Scalar>& records, const Executor& executor) {
    const TreeShape& shape = layout->shape;
    const std::size_t count = layout->numbers.size();
    records.layout = layout;
    const std::size_t size = k_row_count * (count + 1) + k_beyond_records;
    if (records.clusters.records.size() != size) {
        records.clusters.records = RawArray<Scalar>(size);
        std::fill(records.clusters.records.begin(), records.clusters.records.end(), Scalar(0));
    }
    records.clusters.empty = layout->empty;
    if (records.boxes.size() != shape.clusters.size())
        records.boxes = RawArray<ClusterBox<Scalar>>(shape.clusters.size());
    constexpr std::size_t k_clusters = k_chunk / 4;
    each_chunk(
        executor, shape.clusters.size(),
        [&](std::size_t, std::size_t begin, std::size_t end) {
            RecordRewriter<Scalar> rewriter(mesh, layout->numbers, records.clusters, none_is_left_out);
            std::vector<std::uint32_t> none;
            for (std::size_t c = begin; c < end; ++c) {
                records.boxes[c].ref = shape.clusters[c].ref;
                rewriter.rewrite(shape.clusters[c], records.boxes[c], none);
            }
        },
        k_clusters);
}

template <class Scalar>
double layout_cost(const MovingRecords<Scalar>& records, TreeBoxes<Scalar>& boxes) {
    const TreeShape& shape = records.layout->shape;
    if (shape.nodes.empty()) return 1;
    std::copy(records.boxes.begin(), records.boxes.end(), boxes.clusters.begin());
    unite_boxes(shape, boxes);
    bool fits = false;
    const double unit = unit_or_one(boxes.nodes[0], fits);
    const double cost = fits ? expected_cost(shape, boxes, unit) : 0;
    return cost > 0 && records.layout->cost > 0 ? cost / records.layout->cost : 1;
}

template <class Scalar>
void set_step(MovingScene<Scalar>& scene, const Executor& executor) {
    const std::shared_ptr<const MovingLayout<Scalar>>& layout = scene.ends[0]->layout;
    const TreeShape& shape = layout->shape;
    if (scene.layout != layout) {
        scene.layout = layout;
        scene.boxes = TreeBoxes<Scalar>(shape);
        scene.tree = Tree{RawArray<NodeBytes>(layout->tree.node_count), layout->tree.node_count, layout->tree.root,
                          layout->tree.coarse, layout->tree.depth};
        std::copy_n(layout->tree.nodes.begin(), layout->tree.node_count, scene.tree.nodes.begin());
    }
    for (std::size_t c = 0; c < shape.clusters.size(); ++c) {
        QuadBox<Scalar> box = box_of<Scalar>(scene.ends[0]->boxes[c]);
        box.add(box_of<Scalar>(scene.ends[1]->boxes[c]));
        scene.boxes.clusters[c].ref = shape.clusters[c].ref;
        set_box(scene.boxes.clusters[c], box);
    }
    unite_boxes(shape, scene.boxes);
    const QuadBox<Scalar> box = box_of_all(shape, scene.boxes);
    bool fits = false;
    const double unit = unit_or_one(box, fits);
    scene.without_tree = !fits;
    if (scene.without_tree) return;
    scene.frame = frame_around(in_scene_units<Scalar>(box.low, box.high, unit), unit);
    // What comes to the point of a hit is asked about again, so boxes need to hold the way itself only, and what rounds
    // in the kernels: of that 2^-51 of the segment's coordinates is added there, and a way of 2^-60 that it may take
    // for one of length 0 (set_probe.h). In scene units:
    scene.frame.noise = 0x1p-50;
    write_bounds(shape, scene.boxes, scene.frame, scene.tree, executor);
}

#define PIERCE_MOVING(Scalar)                                                                                    \
    template std::shared_ptr<const MovingLayout<Scalar>> make_layout(const PlainMesh<Scalar>&, const Executor&); \
    template void write_records(const std::shared_ptr<const MovingLayout<Scalar>>&, const PlainMesh<Scalar>&,    \
                                MovingRecords<Scalar>&, const Executor&);                                        \
    template double layout_cost(const MovingRecords<Scalar>&, TreeBoxes<Scalar>&);                               \
    template void set_step(MovingScene<Scalar>&, const Executor&)
PIERCE_MOVING(float);
PIERCE_MOVING(double);
#undef PIERCE_MOVING

}  // namespace pierce::detail
