// A kit's file as a library: lengths of your own, and a hole for a screw.
//
// Put this file beside a kit's hexagonal.scad, or name the kit's folder:
//   OPENSCADPATH=out/hexagonal openscad examples/use_library.scad
//
// Units: mm.  SPDX-License-Identifier: MIT

use <hexagonal.scad>

// What to draw
show = "drilled"; // [drilled:Element with a hole for a screw, joint:Joint pulled apart, measured:Size of half A]

// Width of the hole, mm
hole = 3.4; // [1:0.1:5]

/* [Hidden] */

// All live parameters at once; those not named keep the kit's values.
loose = settings(clearance = 0.25, peg_clearance = 0.25);

// A part alone needs no CSG and is drawn at once.  A difference does: a second or two.
module drilled(length = 80) {
    difference() {
        edge_element("basic", length, loose);
        translate([length / 2, 0, 0]) cylinder(d = hole, h = 1000, center = true, $fn = 32);
    }
}

if (show == "drilled") drilled();
else if (show == "joint") joint(explode = 1.5, s = loose);
else if (show == "measured") {
    // [points, faces], as BOSL2's VNFs are
    vnf = part_vnf("half", loose);
    x = [for (p = vnf[0]) p[0]];
    echo(str("half A: ", len(vnf[1]), " triangles, ", max(x) - min(x), " mm along its edge"));
    polyhedron(vnf[0], vnf[1]);
}
else assert(false, str("show = ", show, ": must be drilled, joint or measured"));
