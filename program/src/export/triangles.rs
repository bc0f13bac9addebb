//! Polygons cut into triangles in model space. Convex ones become fans about their first corner, as
//! most programs cut them; from others, ears are cut off.

use super::ExportError;
use alloc::vec::Vec;
use fastphong::mesh::newell::{polygon_normal, unit_normal};
use fastphong::mesh::vertex_normals::{NormalSource, vertex_normals};
use fastphong::mesh::{GivenNormals, MeshBuilder, PolygonMesh};
use fastphong::scene::{Object, Scene};
use glam::{DVec2, DVec3};
use std::sync::Arc;

/// The most corners of a polygon from which ears are cut. The time grows with their square.
const MOST: usize = 16_384;

/// Returns the scene with triangles in place of its polygons, and how many polygons cross
/// themselves and were left out. Vertex normals are those of the polygons.
pub fn in_triangles(scene: &Scene) -> Result<(Scene, usize), ExportError> {
    let (mut cut, mut left_out) = (scene.clone(), 0);
    // Objects may share a mesh.
    let mut known: Vec<(Object, Arc<PolygonMesh>)> = Vec::new();
    for object in &mut cut.objects {
        let mesh = &object.mesh;
        if mesh.polygons().all(|polygon| polygon.len() == 3) {
            continue;
        }
        let is_same = |(other, _): &&(Object, _)| {
            Arc::ptr_eq(&other.mesh, mesh) && other.normals == object.normals
        };
        let triangles = match known.iter().find(is_same) {
            Some((_, triangles)) => triangles.clone(),
            None => {
                let (triangles, crossing) = of_mesh(mesh, object)?;
                left_out += crossing;
                let triangles = Arc::new(triangles);
                known.push((object.clone(), triangles.clone()));
                triangles
            }
        };
        object.mesh = triangles;
        object.normals = NormalSource::Given.into();
    }
    Ok((cut, left_out))
}

/// Returns a mesh of triangles, and how many polygons were left out.
fn of_mesh(mesh: &PolygonMesh, object: &Object) -> Result<(PolygonMesh, usize), ExportError> {
    let normals = vertex_normals(mesh, object.normals);
    let mut builder = MeshBuilder::around(mesh.origin(), mesh.positions().to_vec());
    let (mut normal_indices, mut materials, mut left_out) = (Vec::new(), Vec::new(), 0);
    for polygon in 0..mesh.polygon_count() {
        // No renderer draws a polygon without an area.
        let Some(normal) = unit_normal(polygon_normal(mesh, polygon)) else {
            continue;
        };
        let corners = mesh.polygon(polygon);
        let positions = corners.iter().map(|&c| mesh.positions()[c as usize]);
        let points: Vec<DVec3> = positions.map(|p| p.as_dvec3()).collect();
        let outline = Outline::new(&points, normal);
        if corners.len() > MOST && !outline.is_convex() {
            return Err(ExportError::Corners {
                mesh: object.name.clone(),
                polygon,
                corners: corners.len(),
                most: MOST,
            });
        }
        let Some(triangles) = outline.triangles() else {
            left_out += 1;
            continue;
        };
        let first = mesh.corner_range(polygon).start;
        for triangle in triangles {
            builder.polygon(&triangle.map(|i| corners[i]));
            normal_indices.extend(triangle.map(|i| normals.corners[first + i]));
            let material = mesh.polygon_material(polygon);
            materials.push(material.map_or(u32::MAX, |index| index as u32));
        }
    }
    let names = (0..mesh.materials().len()).map_while(|index| mesh.material_name(index));
    builder
        .normals(GivenNormals::by_corner(normals.values, normal_indices))
        .colours(mesh.colours().to_vec())
        .attributes(mesh.attributes().to_vec())
        .material_names(names.map(Into::into).collect())
        .materials(mesh.materials().to_vec(), materials);
    Ok((builder.finish()?, left_out))
}

/// A polygon in its plane, counter-clockwise.
struct Outline {
    points: Vec<DVec2>,
    /// Twice the area that rounding of coordinates to `f32` may add to a triangle.
    rounding: f64,
}

impl Outline {
    /// Projects a polygon along the axis that is nearest to its normal.
    fn new(points: &[DVec3], normal: DVec3) -> Outline {
        let (n, first) = (normal.abs(), points[0]);
        let flat = |p: &DVec3| {
            let p = *p - first;
            if n.z >= n.x && n.z >= n.y {
                DVec2::new(p.x * normal.z.signum(), p.y)
            } else if n.y >= n.x {
                DVec2::new(p.z * normal.y.signum(), p.x)
            } else {
                DVec2::new(p.y * normal.x.signum(), p.z)
            }
        };
        let flat: Vec<DVec2> = points.iter().map(flat).collect();
        let most = |sizes: &mut dyn Iterator<Item = f64>| sizes.fold(0.0, f64::max);
        let largest = most(&mut points.iter().map(|p| p.abs().max_element()));
        let extent = most(&mut flat.iter().map(|p| p.length()));
        // Each of four differences of coordinates is off by 2⁻²⁴ of the largest one, at each end.
        let rounding = 8.0 * largest * extent / (1 << 24) as f64;
        Outline {
            points: flat,
            rounding,
        }
    }

    /// Returns twice the area of a triangle: over 0 if it runs counter-clockwise.
    fn area(&self, [a, b, c]: [usize; 3]) -> f64 {
        let [a, b, c] = [a, b, c].map(|i| self.points[i]);
        (b - a).perp_dot(c - a)
    }

    /// Returns the fan about the first corner.
    fn fan(&self) -> impl Iterator<Item = [usize; 3]> {
        (2..self.points.len()).map(|i| [0, i - 1, i])
    }

    /// True if the fan covers the polygon.
    fn is_convex(&self) -> bool {
        let count = self.points.len();
        let turns = (0..count).map(|i| [i, (i + 1) % count, (i + 2) % count]);
        // A star turns only to one side, too, but its fan runs back.
        let mut all = turns.chain(self.fan());
        count == 3 || all.all(|corners| self.area(corners) >= -self.rounding)
    }

    /// Returns triangles, as indices of corners, or `None` if the polygon crosses itself.
    fn triangles(&self) -> Option<Vec<[usize; 3]>> {
        if self.is_convex() {
            return Some(self.fan().collect());
        }
        if self.crosses_itself() {
            return None;
        }
        self.ears()
    }

    /// True if two edges cross in a point that is an end of neither.
    fn crosses_itself(&self) -> bool {
        let count = self.points.len();
        let crosses = |i: usize, k: usize| {
            let (j, l) = ((i + 1) % count, (k + 1) % count);
            let are_apart = |a: [usize; 3], b: [usize; 3]| {
                let (a, b) = (self.area(a), self.area(b));
                a.abs() > self.rounding && b.abs() > self.rounding && (a > 0.0) != (b > 0.0)
            };
            are_apart([i, j, k], [i, j, l]) && are_apart([k, l, i], [k, l, j])
        };
        (0..count).any(|i| (i + 2..count).any(|k| crosses(i, k)))
    }

    /// Cuts ears off. Returns `None` if there is none left.
    fn ears(&self) -> Option<Vec<[usize; 3]>> {
        let mut left: Vec<usize> = (0..self.points.len()).collect();
        let (mut ears, mut at) = (Vec::new(), 1);
        while left.len() > 3 {
            let count = left.len();
            let around = |i: usize| {
                [
                    left[(i + count - 1) % count],
                    left[i],
                    left[(i + 1) % count],
                ]
            };
            let holds = |ear: [usize; 3], point: usize| {
                let [a, b, c] = ear;
                let is_corner = ear.iter().any(|&i| self.points[i] == self.points[point]);
                let edges = [[a, b, point], [b, c, point], [c, a, point]];
                !is_corner && edges.iter().all(|&edge| self.area(edge) >= 0.0)
            };
            let is_ear = |i: &usize| {
                let ear = around(*i);
                self.area(ear) > 0.0 && !left.iter().any(|&point| holds(ear, point))
            };
            // A corner in a straight line, or the tip of a spike, adds no area.
            let is_flat = |i: &usize| self.area(around(*i)).abs() <= self.rounding;
            let from_here = || (at..at + count).map(|i| i % count);
            at = from_here()
                .find(is_ear)
                .or_else(|| from_here().find(is_flat))?;
            ears.push(around(at));
            left.remove(at);
        }
        ears.push([left[0], left[1], left[2]]);
        Some(ears)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn cut(points: &[(f64, f64)]) -> Option<Vec<[usize; 3]>> {
        let points: Vec<DVec3> = points.iter().map(|&(x, y)| DVec3::new(x, y, 1.0)).collect();
        Outline::new(&points, DVec3::Z).triangles()
    }

    #[test]
    fn a_convex_polygon_becomes_a_fan_about_its_first_corner() {
        let square = [(0.0, 0.0), (2.0, 0.0), (2.0, 2.0), (1.0, 2.0), (0.0, 2.0)];
        assert_eq!(cut(&square), Some(vec![[0, 1, 2], [0, 2, 3], [0, 3, 4]]));
    }

    #[test]
    fn ears_cover_a_concave_polygon_once() {
        let arrow = [(0.0, 0.0), (4.0, 0.0), (1.0, 1.0), (0.0, 4.0)];
        let comb = [
            (0.0, 0.0),
            (7.0, 0.0),
            (7.0, 5.0),
            (6.0, 1.0),
            (5.0, 5.0),
            (4.0, 1.0),
            (3.0, 5.0),
            (2.0, 1.0),
            (1.0, 5.0),
        ];
        for (polygon, area) in [(&arrow[..], 4.0), (&comb[..], 20.5)] {
            let triangles = cut(polygon).expect("triangles");
            assert_eq!(triangles.len(), polygon.len() - 2);
            let points: Vec<DVec3> = polygon
                .iter()
                .map(|&(x, y)| DVec3::new(x, y, 0.0))
                .collect();
            let outline = Outline::new(&points, DVec3::Z);
            // Every triangle runs the polygon's way, so none lies on another if the sum is right.
            assert!(triangles.iter().all(|t| outline.area(*t) >= 0.0));
            let sum: f64 = triangles.iter().map(|t| outline.area(*t) / 2.0).sum();
            assert_eq!(sum, area);
        }
    }

    #[test]
    fn a_polygon_that_crosses_itself_has_no_triangles() {
        assert_eq!(cut(&[(0.0, 0.0), (4.0, 3.0), (4.0, 0.0), (0.0, 2.0)]), None);
        // A star of five corners turns only to the left.
        let tip = |k: f64| {
            let angle = k * 144.0_f64.to_radians();
            (angle.cos(), angle.sin())
        };
        assert_eq!(cut(&[0.0, 1.0, 2.0, 3.0, 4.0].map(tip)), None);
    }
}
