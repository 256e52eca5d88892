#pragma once

#include "stimuli/scenes/modelling/assembler.h"
#include "stimuli/scenes/modelling/parts.h"

namespace plenolab {

/// Small things of polished metal and glass that lie about on a desk whose top is the plane z = 0. Polished
/// surfaces are ideal mirrors or have a roughness of a few hundredths, so that each shows a sharp, tiny image
/// of a lamp.
struct StationeryMaterials {
  int steel, brass, copper, gold, chrome, glass, enamel, lacquer_black, lacquer_red, lacquer_blue;
};
StationeryMaterials stationery_materials(SceneAssembler& scene);

/// A paper clip of wire, flat on the desk.
Mesh paper_clip(float length_m);
/// A countersunk screw that lies on its side, its head at the origin, pointing along +x.
Mesh screw(float length_m);
/// A coin with a raised rim, its lower face at z = 0.
Mesh coin(float diameter_m);
/// A drawing pin that lies on its domed head, point up.
Mesh drawing_pin(float diameter_m);

/// Ball pen or fountain pen along +x, its middle above the origin: barrel of `barrel`, fittings of `metal`.
void add_pen(SceneAssembler& scene, int barrel, int metal, const Eigen::Affine3f& at, float length_m);
/// A tumbler of glass, closed surfaces inside and out, its foot at the origin.
Mesh tumbler(float height_m);
/// Open pocket watch that lies on its back: case of `metal`, `dial` with hands and hour marks of `hands`.
void add_watch(SceneAssembler& scene, int metal, int dial, int hands, const Eigen::Affine3f& at);
/// A flat ring, lying at z = 0.
Mesh washer(float diameter_m);

/// All of it, some three hundred pieces, scattered over x in [−0.6, 0.6], y in [0.4, 1.15].
void add_stationery(SceneAssembler& scene, const StationeryMaterials& materials);

}  // namespace plenolab
