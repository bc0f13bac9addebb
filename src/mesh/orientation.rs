//! Closed surfaces of a mesh that are wound inside out.

use super::PolygonMesh;
use super::edges::{EdgeUse, Edges};
use super::newell::newell;
use super::weld::weld;
use alloc::vec;
use alloc::vec::Vec;
use core::f64::consts::PI;
use glam::DVec3;

/// A volume counts as zero if it is no larger than this part of the summed sizes of its terms. The
/// limit is far above the rounding of the sum in `f64` and far below any solid.
const NO_VOLUME: f64 = 1e-9;

/// How many closed surfaces of a mesh are wound inside out.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct InsideOut {
    /// The count of surfaces.
    pub surfaces: usize,
    /// The count of polygons of all of them.
    pub polygons: usize,
}

/// Finds the closed surfaces of `mesh` that are wound inside out.
///
/// A surface consists of polygons of one part that are linked by edges. It is closed if polygons
/// run along every edge once in each direction. It is inside out if its volume is negative, because
/// its polygons are then clockwise seen from outside. The surface of a cavity inside another
/// surface of its part is meant to be so, and does not count.
pub fn inside_out(mesh: &PolygonMesh) -> InsideOut {
    // A quick test that settles nearly all meshes. Polygons that share positions by index make
    // pieces, and finding these takes no sorting. A surface with a negative volume has a piece with
    // a negative volume, if it shares no position with another surface.
    let mut pieces = Groups::new(mesh.positions().len());
    for polygon in mesh.polygons() {
        for &corner in polygon {
            pieces.join(polygon[0], corner);
        }
    }
    let mut volumes = vec![0.0; mesh.positions().len()];
    for polygon in mesh.polygons() {
        volumes[pieces.first(polygon[0]) as usize] += volume(mesh, polygon);
    }
    if volumes.iter().all(|&volume| volume >= 0.0) {
        return InsideOut::default();
    }
    let surfaces = closed_surfaces(mesh);
    let cavities = cavities(mesh, &surfaces);
    let mut found = InsideOut::default();
    for (surface, is_cavity) in surfaces.iter().zip(cavities) {
        if surface.volume < 0.0 && !is_cavity {
            found.surfaces += 1;
            found.polygons += surface.polygons.len();
        }
    }
    found
}

/// True if `point`, relative to the origin of `mesh`, lies inside one of its closed surfaces.
pub fn is_inside_closed_surface(mesh: &PolygonMesh, point: DVec3) -> bool {
    let is_within = |[low, high]: [DVec3; 2]| low.cmplt(point).all() && point.cmplt(high).all();
    let of_mesh = mesh.bounds();
    if !of_mesh.is_some_and(|(low, high)| is_within([low, high].map(|p| p - mesh.origin()))) {
        return false;
    }
    let surfaces = closed_surfaces(mesh);
    let mut around = surfaces.iter().filter(|surface| is_within(surface.bounds));
    around.any(|surface| surface.holds(mesh, point))
}

/// Returns six times the signed volume of the cone from 0 to a polygon of any shape.
fn volume(mesh: &PolygonMesh, polygon: &[u32]) -> f64 {
    let mut corners = polygon.iter().map(|&c| position(mesh, c));
    let first = position(mesh, polygon[0]);
    first.dot(newell(&mut corners))
}

fn position(mesh: &PolygonMesh, corner: u32) -> DVec3 {
    mesh.positions()[corner as usize].as_dvec3()
}

/// A closed surface with a volume.
struct Surface {
    part: u32,
    polygons: Vec<u32>,
    /// Six times the volume inside; negative if the surface is wound inside out.
    volume: f64,
    /// The smallest and the largest coordinates.
    bounds: [DVec3; 2],
}

/// Returns the closed surfaces of `mesh` that have a volume.
fn closed_surfaces(mesh: &PolygonMesh) -> Vec<Surface> {
    let (vertex, count) = weld(mesh.positions());
    let mut linked = Groups::new(mesh.polygon_count());
    let mut is_open = vec![false; mesh.polygon_count()];
    let part = |of: &EdgeUse| mesh.part(of.polygon as usize);
    let mut uses = Vec::new();
    for edge in Edges::new(mesh, &vertex, count).iter() {
        uses.clear();
        uses.extend_from_slice(edge);
        uses.sort_by_key(part);
        // Where several parts meet, each part has its own edge.
        for uses in uses.chunk_by(|a, b| part(a) == part(b)) {
            let is_closed = matches!(uses, [a, b] if a.ascends != b.ascends);
            for of in uses {
                linked.join(uses[0].polygon, of.polygon);
                is_open[of.polygon as usize] |= !is_closed;
            }
        }
    }
    let mut members: Vec<(u32, u32)> = (0..mesh.polygon_count() as u32)
        .map(|p| (linked.first(p), p))
        .collect();
    members.sort_unstable();
    members
        .chunk_by(|a, b| a.0 == b.0)
        .map(|members| members.iter().map(|&(_, p)| p).collect::<Vec<u32>>())
        .filter(|polygons| !polygons.iter().any(|&p| is_open[p as usize]))
        .filter_map(|polygons| Surface::new(mesh, polygons))
        .collect()
}

impl Surface {
    /// Measures a closed surface; `None` if it has no volume.
    fn new(mesh: &PolygonMesh, polygons: Vec<u32>) -> Option<Surface> {
        let (mut sum, mut sizes) = (0.0, 0.0);
        let mut bounds = [DVec3::INFINITY, DVec3::NEG_INFINITY];
        for &p in &polygons {
            let polygon = mesh.polygon(p as usize);
            let volume = volume(mesh, polygon);
            sum += volume;
            sizes += libm::fabs(volume);
            for &corner in polygon {
                let at = position(mesh, corner);
                bounds = [bounds[0].min(at), bounds[1].max(at)];
            }
        }
        let part = mesh.part(*polygons.first()? as usize);
        (libm::fabs(sum) > NO_VOLUME * sizes).then_some(Surface {
            part,
            polygons,
            volume: sum,
            bounds,
        })
    }

    /// True if `other` is a surface of the same part and its bounds lie within the bounds of this
    /// one.
    fn may_hold(&self, other: &Surface) -> bool {
        let [low, high] = self.bounds;
        self.part == other.part
            && low.cmple(other.bounds[0]).all()
            && high.cmpge(other.bounds[1]).all()
    }

    /// True if a point lies inside. Seen from there, the surface fills the whole sphere of
    /// directions: a solid angle of ±4π, while from outside it is 0. The test compares with the
    /// middle, 2π.
    fn holds(&self, mesh: &PolygonMesh, point: DVec3) -> bool {
        let mut angle = 0.0;
        for &p in &self.polygons {
            let polygon = mesh.polygon(p as usize);
            let from = |corner: u32| position(mesh, corner) - point;
            // Angles have signs, so a fan adds up to the polygon, whatever its shape.
            for pair in polygon[1..].windows(2) {
                angle += solid_angle(from(polygon[0]), from(pair[0]), from(pair[1]));
            }
        }
        libm::fabs(angle) > 2.0 * PI
    }
}

/// Returns the signed solid angle of a triangle as seen from 0 (Van Oosterom and Strackee, 1983).
fn solid_angle(a: DVec3, b: DVec3, c: DVec3) -> f64 {
    let (la, lb, lc) = (a.length(), b.length(), c.length());
    let denominator = la * lb * lc + a.dot(b) * lc + b.dot(c) * la + c.dot(a) * lb;
    2.0 * libm::atan2(a.dot(b.cross(c)), denominator)
}

/// Returns for each surface if it bounds a cavity: it is inside out, and of the surfaces of its
/// part that contain it more are wound outward than inward.
fn cavities(mesh: &PolygonMesh, surfaces: &[Surface]) -> Vec<bool> {
    let mut is_cavity = vec![false; surfaces.len()];
    let mut order: Vec<usize> = (0..surfaces.len()).collect();
    let ends = |i: usize| surfaces[i].bounds.map(|corner| corner.x);
    // A sweep along x. Of surfaces that begin together the longer one comes first, because it may
    // contain the other.
    order.sort_by(|&a, &b| {
        let ([low_a, high_a], [low_b, high_b]) = (ends(a), ends(b));
        low_a.total_cmp(&low_b).then(high_b.total_cmp(&high_a))
    });
    // The surfaces that the sweep has entered and not yet left.
    let mut reached: Vec<usize> = Vec::new();
    for i in order {
        let surface = &surfaces[i];
        reached.retain(|&other| ends(other)[1] >= ends(i)[0]);
        if surface.volume < 0.0 {
            let point = position(mesh, mesh.polygon(surface.polygons[0] as usize)[0]);
            let around = reached
                .iter()
                .map(|&other| &surfaces[other])
                .filter(|other| other.may_hold(surface) && other.holds(mesh, point));
            is_cavity[i] = around.map(|other| other.volume.signum()).sum::<f64>() > 0.0;
        }
        reached.push(i);
    }
    is_cavity
}

/// A union-find over indices. The smallest index of a group stands for it.
struct Groups {
    leader: Vec<u32>,
}

impl Groups {
    fn new(count: usize) -> Self {
        Groups {
            leader: (0..count as u32).collect(),
        }
    }

    /// Returns the index that stands for the group of `i`.
    fn first(&mut self, mut i: u32) -> u32 {
        while self.leader[i as usize] != i {
            // Path halving keeps later walks short.
            let above = self.leader[self.leader[i as usize] as usize];
            self.leader[i as usize] = above;
            i = above;
        }
        i
    }

    fn join(&mut self, a: u32, b: u32) {
        let (a, b) = (self.first(a), self.first(b));
        self.leader[a.max(b) as usize] = a.min(b);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::MeshBuilder;
    use crate::mesh::builtin::builtin;
    use glam::Vec3;

    /// Returns a built-in shape, moved by `by` and without its first `without` polygons. `reversed`
    /// reverses all others.
    fn shape(spec: &str, by: Vec3, reversed: bool, without: usize) -> (Vec<Vec3>, Vec<Vec<u32>>) {
        let mesh = builtin(spec).expect("a shape");
        let polygons = mesh.polygons().skip(without).map(|polygon| {
            let mut polygon = polygon.to_vec();
            if reversed {
                polygon.reverse();
            }
            polygon
        });
        (
            mesh.positions().iter().map(|p| *p + by).collect(),
            polygons.collect(),
        )
    }

    fn count(shapes: &[(Vec<Vec3>, Vec<Vec<u32>>)], as_parts: bool) -> usize {
        let positions = shapes.iter().flat_map(|shape| shape.0.iter().copied());
        let mut builder = MeshBuilder::new(positions.collect());
        let (mut first, mut parts) = (0, Vec::new());
        for (part, (positions, polygons)) in shapes.iter().enumerate() {
            for polygon in polygons {
                let moved: Vec<u32> = polygon.iter().map(|c| c + first).collect();
                builder.polygon(&moved);
                parts.push(part as u32);
            }
            first += positions.len() as u32;
        }
        if as_parts {
            builder.parts(parts);
        }
        inside_out(&builder.finish().expect("a mesh")).surfaces
    }

    #[test]
    fn closed_shapes_that_are_wound_inside_out_are_counted() {
        for spec in [
            "cube",
            "sphere?rings=6&segments=8",
            "torus",
            "gear",
            "knot?polygons=500",
        ] {
            for by in [Vec3::ZERO, Vec3::new(5.0, -7.0, 2.0)] {
                assert_eq!(count(&[shape(spec, by, false, 0)], false), 0, "{spec}");
                assert_eq!(count(&[shape(spec, by, true, 0)], false), 1, "{spec}");
                // With a hole in the surface there is no inside.
                assert_eq!(count(&[shape(spec, by, true, 1)], false), 0, "{spec}");
            }
        }
        assert_eq!(count(&[], false), 0);
    }

    #[test]
    fn each_surface_is_judged_by_itself_and_a_cavity_does_not_count() {
        let by = Vec3::new(9.0, 0.0, 0.0);
        let [right, wrong] = [false, true].map(|reversed| shape("cube", by, reversed, 0));
        let mut around = shape("cube", Vec3::ZERO, false, 0);
        around.0.iter_mut().for_each(|p| *p = by + 3.0 * *p);
        for as_parts in [false, true] {
            let apart = shape("cube", -by, true, 0);
            assert_eq!(count(&[right.clone(), apart], as_parts), 1);
        }
        assert_eq!(count(&[wrong.clone(), wrong.clone()], true), 2);
        assert_eq!(count(&[around.clone(), wrong.clone()], false), 0);
        // A cavity in a solid, a solid in that cavity, and a cavity in that solid. Wound the other
        // way around, the solids are wrong, and the cavities are cavities still.
        let sized = |factor: f32, reversed| {
            let mut cube = shape("cube", Vec3::ZERO, reversed, 0);
            cube.0.iter_mut().for_each(|p| *p = by + factor * *p);
            cube
        };
        let nest = |wrong: [bool; 4]| {
            let sizes = [3.0, 0.5, 0.2, 0.1];
            [0, 1, 2, 3].map(|i| sized(sizes[i], wrong[i]))
        };
        assert_eq!(count(&nest([false, true, false, true]), false), 0);
        assert_eq!(count(&nest([true, false, true, false]), false), 2);
        // Within the bounds of a ring, and beside it.
        let mut small = shape("cube", Vec3::ZERO, true, 0);
        small.0.iter_mut().for_each(|p| *p *= 0.05);
        let ring = shape("torus", Vec3::ZERO, false, 0);
        assert_eq!(count(&[ring.clone(), small.clone()], false), 1);
        // The order of the shapes does not matter.
        assert_eq!(count(&[small, ring, around, wrong], false), 1);
    }

    #[test]
    fn surfaces_that_touch_in_a_vertex_are_two_and_repeated_positions_one() {
        let by = Vec3::splat(2.0);
        let [here, there] = [false, true].map(|reversed| {
            let by = if reversed { by } else { Vec3::ZERO };
            shape("cube", by, reversed, 0)
        });
        let touching = [here, there];
        assert!(touching[1].0.iter().any(|p| touching[0].0.contains(p)));
        assert_eq!(count(&touching, false), 1);
        // Each polygon has its own corners, as exporters of triangles write them.
        let soup = |(positions, polygons): &(Vec<Vec3>, Vec<Vec<u32>>)| {
            let all = polygons.iter().flatten();
            let own: Vec<Vec3> = all.map(|&c| positions[c as usize]).collect();
            let mut indices = 0..own.len() as u32;
            let lists = polygons
                .iter()
                .map(|list| indices.by_ref().take(list.len()).collect())
                .collect();
            (own, lists)
        };
        assert_eq!(count(&touching.each_ref().map(soup), false), 1);
    }

    #[test]
    fn points_must_be_inside_the_surface_not_only_inside_its_bounds() {
        let torus = builtin("torus").expect("a shape");
        let on_ring = torus.positions()[torus.polygon(0)[0] as usize].as_dvec3();
        assert!(is_inside_closed_surface(
            &builtin("cube").expect("a shape"),
            DVec3::splat(0.1)
        ));
        assert!(
            !is_inside_closed_surface(&torus, DVec3::ZERO),
            "in the hole"
        );
        assert!(!is_inside_closed_surface(&torus, 2.0 * on_ring), "outside");
        let (positions, polygons) = shape("cube", Vec3::ZERO, false, 1);
        let mut open = MeshBuilder::new(positions);
        polygons.iter().for_each(|polygon| {
            open.polygon(polygon);
        });
        let open = open.finish().expect("a mesh");
        assert!(
            !is_inside_closed_surface(&open, DVec3::splat(0.1)),
            "in an open one"
        );
    }

    #[test]
    fn a_sheet_with_two_sides_has_no_volume() {
        let positions: Vec<Vec3> = [[0.1, 0.7, 3.0], [1.3, 0.9, 2.0], [0.4, 1.9, 1.7]]
            .map(Vec3::from)
            .to_vec();
        for polygons in [[[0, 1, 2], [0, 2, 1]], [[0, 2, 1], [1, 2, 0]]] {
            let polygons = polygons.map(|p| p.to_vec()).to_vec();
            assert_eq!(count(&[(positions.clone(), polygons)], false), 0);
        }
    }
}
