//! Whether a closed mesh is wound inside out.

use super::PolygonMesh;
use super::newell::newell;
use super::weld::weld;
use alloc::vec;
use alloc::vec::Vec;

/// The part of the summed sizes of its terms by which a volume must be below 0: far above the rounding of the sum in `f64`,
/// and far below any solid.
const NO_VOLUME: f64 = 1e-9;

/// Returns the number of parts of `mesh` that are closed and wound inside out: every edge is run once in either direction,
/// and the volume inside is negative, as polygons are clockwise seen from outside.
///
/// A part with a cavity in it has its outer surface wound rightly, and a positive volume.
pub fn inside_out_parts(mesh: &PolygonMesh) -> usize {
    let parts = (0..mesh.polygon_count()).map(|p| mesh.part(p) as usize + 1);
    let mut volumes = vec![(0.0, 0.0); parts.max().unwrap_or(0)];
    for (p, polygon) in mesh.polygons().enumerate() {
        let corners = polygon
            .iter()
            .map(|&c| mesh.positions()[c as usize].as_dvec3());
        let first = mesh.positions()[polygon[0] as usize].as_dvec3();
        // Six times the volume of the cone over the polygon, whatever its shape.
        let volume = first.dot(newell(corners));
        let (sum, sizes) = &mut volumes[mesh.part(p) as usize];
        *sum += volume;
        *sizes += libm::fabs(volume);
    }
    let is_negative = |part: u32| {
        let (volume, sizes) = volumes[part as usize];
        volume < -NO_VOLUME * sizes
    };
    if !(0..volumes.len() as u32).any(is_negative) {
        return 0;
    }
    // Closedness takes a sort, and nearly no mesh comes here.
    let (vertex, _) = weld(mesh.positions());
    let mut edges: Vec<(u32, u32, u32, bool)> = Vec::new();
    for (p, polygon) in mesh.polygons().enumerate() {
        let part = mesh.part(p);
        if !is_negative(part) {
            continue;
        }
        for (k, &from) in polygon.iter().enumerate() {
            let to = polygon[(k + 1) % polygon.len()];
            let (from, to) = (vertex[from as usize], vertex[to as usize]);
            if from != to {
                edges.push((part, from.min(to), from.max(to), from < to));
            }
        }
    }
    edges.sort_unstable();
    let of_parts = edges.chunk_by(|a, b| a.0 == b.0);
    let is_closed = |edges: &&[(u32, u32, u32, bool)]| {
        let mut edges = edges.chunk_by(|a, b| (a.1, a.2) == (b.1, b.2));
        edges.all(|edge| matches!(edge, [(.., false), (.., true)]))
    };
    of_parts.filter(is_closed).count()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::MeshBuilder;
    use crate::mesh::builtin::builtin;
    use glam::Vec3;

    /// A built-in shape moved by `by`, its polygons reversed if asked for; without the first `without` ones.
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
        for (number, (positions, polygons)) in shapes.iter().enumerate() {
            for polygon in polygons {
                let moved: Vec<u32> = polygon.iter().map(|c| c + first).collect();
                builder.polygon(&moved);
                parts.push(number as u32);
            }
            first += positions.len() as u32;
        }
        if as_parts {
            builder.parts(parts);
        }
        inside_out_parts(&builder.finish().expect("a mesh"))
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
                // With a hole, inside and outside are not two things.
                assert_eq!(count(&[shape(spec, by, true, 1)], false), 0, "{spec}");
            }
        }
        assert_eq!(count(&[], false), 0);
    }

    #[test]
    fn each_part_is_judged_by_itself_and_a_cavity_is_none() {
        let by = Vec3::new(9.0, 0.0, 0.0);
        let [right, wrong] = [false, true].map(|reversed| shape("cube", by, reversed, 0));
        let mut around = shape("cube", Vec3::ZERO, false, 0);
        around.0.iter_mut().for_each(|p| *p = by + 3.0 * *p);
        assert_eq!(count(&[right.clone(), wrong.clone()], true), 1);
        assert_eq!(count(&[wrong.clone(), wrong.clone()], true), 2);
        assert_eq!(count(&[around, wrong], false), 0);
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
