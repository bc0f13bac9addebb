//! Cutting polygons that reach beyond a plane, and adding the pieces inside to the frame.

use super::clip::{Cut, HomogeneousCorner, Plane, clip};
use super::polygons::{Piece, PolygonTable};
use super::side::{Side, eye_side};
use super::view::View;
use super::winding::doubled_area;
use crate::frame::{ClipCorner, Frame, Mean};
use crate::scene::{Culling, Interpolation};
use alloc::vec;
use alloc::vec::Vec;
use glam::DMat4;

/// A cutter of a scene's polygons, which adds their pieces to the frame.
pub(super) struct Cutting<'a> {
    pub view: &'a View<'a>,
    pub table: &'a PolygonTable,
    pub frame: &'a mut Frame,
    pub pieces: &'a mut Vec<Piece>,
}

impl Cutting<'_> {
    /// Adds the pieces of a polygon that are inside all planes. Counts the polygon as clipped, or
    /// as outside if nothing is left of it.
    pub fn polygon(&mut self, polygon: usize) {
        let geometry = self.frame.geometry.clone();
        let (first, count) = self.table.corners(polygon);
        let corners = &geometry.corners[first as usize..][..count as usize];
        let object = &geometry.models.objects[geometry.models.object_of(corners[0] as usize)];
        let matrix = self.view.clip_matrix * DMat4::from(object.transform);
        let clip_position = |&v: &u32| matrix * geometry.models.position(v as usize).extend(1.0);
        let is_clockwise = eye_side(corners.iter().map(clip_position)) < 0.0;
        let is_behind = is_clockwise != self.table.is_turned(polygon);
        let side = if self.view.scene.two_sided && is_behind {
            Side::Back
        } else {
            Side::Front
        };
        let other_side = if side == Side::Back {
            geometry.models.count() as u32
        } else {
            0
        };
        let whole: Vec<u32> = corners.iter().map(|v| v + other_side).collect();
        let mut face = geometry.faces[polygon];
        side.turn(&mut face);
        let edge = EdgeOf {
            material: self.table.material(polygon),
            face,
        };
        let ends = corners
            .iter()
            .map(clip_position)
            .zip(&whole)
            .map(|(position, &vertex)| HomogeneousCorner { position, vertex });
        let mean = self.frame.mean_of(&whole);
        let mut cutter = Cutter {
            view: self.view,
            frame: self.frame,
        };
        for (first, count) in cutter.pieces(ends.collect(), mean, &edge) {
            self.pieces.push(Piece {
                source: polygon as u32,
                first,
                count,
                is_back: side == Side::Back,
            });
        }
    }
}

/// A cutter of polygons in clip space from any source. It adds vertices, corners and means of the
/// pieces to the frame.
pub(in crate::frame) struct Cutter<'a> {
    pub view: &'a View<'a>,
    pub frame: &'a mut Frame,
}

impl Cutter<'_> {
    /// Cuts a polygon, and counts it as clipped, or as outside if nothing is left of it. `mean` is
    /// the mean of the whole polygon. Returns the first corner and the count of corners of each
    /// piece that is drawn.
    pub fn pieces(
        &mut self,
        corners: Vec<HomogeneousCorner>,
        mean: Mean,
        edge: &EdgeOf,
    ) -> Vec<(u32, u32)> {
        let mut pieces = vec![corners];
        for plane in self.view.planes {
            let mut inside = Vec::new();
            for piece in &pieces {
                clip(
                    piece,
                    &plane,
                    |cut| self.vertex(cut, &plane, edge),
                    |part| inside.push(part.to_vec()),
                );
            }
            pieces = inside;
        }
        // Two kinds of cuts have no place on the picture. On edges that reach some 10⁹ times as far
        // as they are away, rounding may put a cut beyond its plane. And nearer than 10⁻³⁸, 1/w is
        // no `f32`.
        let is_placed = |corner: &HomogeneousCorner| {
            self.view.is_on_picture(corner.position)
                && self
                    .view
                    .is_valid(&self.frame.vertices[corner.vertex as usize])
        };
        if !pieces.iter().flatten().all(is_placed) {
            self.frame.stats.unprojected += 1;
            return Vec::new();
        }
        if pieces.is_empty() {
            self.frame.stats.outside += 1;
        } else {
            self.frame.stats.clipped += 1;
        }
        pieces.retain(|piece| {
            self.is_drawn(doubled_area(
                piece.iter().map(|c| self.view.snap(c.position)),
            ))
        });
        let pieces = pieces.iter();
        pieces.map(|piece| self.piece(piece, mean)).collect()
    }

    /// True if a piece with this signed area on the picture is drawn. Counts it if it is not.
    fn is_drawn(&mut self, area: i128) -> bool {
        let culled = match self.view.scene.culling {
            Culling::Back => area > 0,
            Culling::Front => area < 0,
            Culling::None => false,
        };
        self.frame.stats.culled += usize::from(culled);
        self.frame.stats.edge_on += usize::from(area == 0);
        !culled && area != 0
    }

    /// Adds the corners of a piece to the frame. Returns the first of them and how many there are.
    fn piece(&mut self, corners: &[HomogeneousCorner], mean: Mean) -> (u32, u32) {
        debug_assert!(corners.len() >= 3, "clipping leaves polygons");
        let frame = &mut *self.frame;
        // Corner lists of pieces are numbered behind the lists of the geometry.
        let first = (frame.geometry.corners.len() + frame.cut_corners.len()) as u32;
        frame.means.push((first, mean));
        frame
            .cut_corners
            .extend(corners.iter().map(|corner| corner.vertex));
        (first, corners.len() as u32)
    }

    /// Adds the vertex where a plane cuts an edge, and returns its index. Its attributes lie
    /// between the attributes of the edge's ends.
    fn vertex(&mut self, cut: &Cut, plane: &Plane, edge: &EdgeOf) -> u32 {
        let index = self.frame.vertices.len() as u32;
        self.frame.vertices.push(self.view.vertex(cut.position));
        self.frame.cut_materials.push(edge.material);
        // Attributes that are linear on the screen are divided there, if both ends have a place on
        // it.
        let on_screen = self.view.scene.interpolation == Interpolation::Screen && plane.in_front;
        let t = if on_screen { cut.t_on_screen() } else { cut.t };
        let (a, b) = (cut.a.vertex, cut.b.vertex);
        debug_assert!(
            a.max(b) < index,
            "the ends of an edge are numbered before its cuts"
        );
        self.frame.clip_corners.push(ClipCorner {
            vertex: index,
            a,
            b,
            t: t as f32,
            face: edge.face,
        });
        index
    }
}

/// What a vertex on an edge inherits from the edge's polygon.
pub(in crate::frame) struct EdgeOf {
    pub material: u32,
    pub face: [f32; 3],
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::frame::FrameStats;
    use crate::mesh::{Material, MeshBuilder};
    use crate::scene::{Camera, Object, Projection, Scene};
    use glam::{DAffine3, DVec3, Vec3};

    /// Returns a scene of polygons, each with its own material. A camera at the origin looks toward
    /// −z at 4 × 4 pixels, each one unit wide, with (0, 0) in the middle. The near plane is at z =
    /// −1, the far plane at z = −3.
    fn scene(polygons: &[&[[f32; 3]]]) -> Scene {
        let positions = polygons.concat().into_iter().map(Vec3::from_array);
        let mut builder = MeshBuilder::new(positions.collect());
        let mut first = 0;
        for corners in polygons {
            let end = first + corners.len() as u32;
            builder.polygon(&(first..end).collect::<Vec<_>>());
            first = end;
        }
        let count = polygons.len();
        builder.materials(
            vec![Material::default(); count],
            (0..count as u32).collect(),
        );
        Scene {
            width: 4,
            height: 4,
            objects: vec![Object::new(builder.finish().expect("a mesh"))],
            ..Scene::new(Camera {
                eye: DVec3::ZERO,
                target: -DVec3::Z,
                up: DVec3::Y,
                projection: Projection::Orthographic { half_height: 2.0 },
                near: 1.0,
                far: 3.0,
            })
        }
    }

    fn frame(scene: &Scene) -> Frame {
        scene.frame().expect("a frame")
    }

    /// Returns column, row and depth of a polygon's corners.
    fn outline(frame: &Frame, polygon: usize) -> Vec<[f64; 3]> {
        let corners = frame.corners(&frame.polygons()[polygon]).iter();
        let vertices = corners.map(|&v| frame.vertices()[v as usize]);
        vertices
            .map(|v| [v.x.to_num(), v.y.to_num(), v.depth])
            .collect()
    }

    /// A square that rises to the right, from half-way between the planes through the near plane.
    const RISING: [[f32; 3]; 4] = [
        [-1.0, -1.0, -2.0],
        [1.0, -1.0, 0.0],
        [1.0, 1.0, 0.0],
        [-1.0, 1.0, -2.0],
    ];

    fn reversed<const N: usize>(mut corners: [[f32; 3]; N]) -> [[f32; 3]; N] {
        corners.reverse();
        corners
    }

    fn counts(polygons: usize) -> FrameStats {
        FrameStats {
            polygons,
            ..FrameStats::default()
        }
    }

    #[test]
    fn pieces_have_corners_material_and_mean_of_their_polygons() {
        let lower = RISING.map(|[x, y, z]| [x, y - 1.0, z]);
        let mut scene = scene(&[&RISING, &lower]);
        scene.objects[0].transform = DAffine3::from_translation(DVec3::new(0.0, 0.5, 0.0));
        let frame = frame(&scene);
        let clipped = 2;
        assert_eq!(
            frame.stats(),
            FrameStats {
                clipped,
                ..counts(2)
            }
        );
        for (index, top) in [(0, 0.5), (1, 1.5)] {
            let bottom: f64 = top + 2.0;
            let expected = [
                [1.0, bottom, 0.5],
                [2.0, bottom, 0.0],
                [2.0, top, 0.0],
                [1.0, top, 0.5],
            ];
            let mut found = outline(&frame, index);
            let first = found.iter().position(|at| *at == expected[0]);
            found.rotate_left(first.expect("its first corner"));
            assert_eq!(found, expected);
            let polygon = &frame.polygons()[index];
            assert_eq!(polygon.source, index as u32);
            assert_eq!(polygon.material, index as u32);
            let corners = frame.corners(polygon);
            assert!(corners.iter().all(|&v| frame.material(v) == index as u32));
            // The mean is the whole polygon's.
            assert_eq!(
                frame.mean(polygon).position,
                [0.0, 2.0 - 0.5 * (top + bottom) as f32, -1.0]
            );
        }
    }

    /// As documented at [`Interpolation`]: linear on the screen unless by perspective, where the
    /// screen has a place for both ends.
    #[test]
    fn attributes_are_divided_on_the_screen_only_behind_the_near_plane() {
        let through = |z: [f32; 2]| [[-0.5, 0.0, z[0]], [0.5, 0.0, z[1]], [0.5, 0.5, z[1]]];
        let (near, far) = (through([-1.5, -0.5]), through([-2.0, -4.0]));
        // Both planes are half-way along the edges in space. On the screen the far one is at (½
        // · 4) / (½ · 2 + ½ · 4).
        for (corners, interpolation, t) in [
            (near, Interpolation::Screen, 0.5),
            (near, Interpolation::Perspective, 0.5),
            (far, Interpolation::Screen, 2.0 / 3.0),
            (far, Interpolation::Perspective, 0.5),
        ] {
            let mut scene = scene(&[&corners]);
            scene.camera.projection = Projection::Perspective { fovy: 90.0 };
            scene.interpolation = interpolation;
            let frame = frame(&scene);
            let found: Vec<f32> = frame.clip_corners().iter().map(|c| c.t).collect();
            assert_eq!(found, [t; 2], "{corners:?} {interpolation:?}");
        }
    }

    #[test]
    fn clipped_polygons_are_culled_like_others() {
        for (corners, is_front) in [(RISING, true), (reversed(RISING), false)] {
            for (culling, is_drawn) in [
                (Culling::Back, is_front),
                (Culling::Front, !is_front),
                (Culling::None, true),
            ] {
                let mut scene = scene(&[&corners]);
                scene.culling = culling;
                let frame = frame(&scene);
                let expected = FrameStats {
                    clipped: 1,
                    culled: usize::from(!is_drawn),
                    ..counts(1)
                };
                assert_eq!(frame.stats(), expected, "{culling:?}");
                assert_eq!(frame.polygons().len(), usize::from(is_drawn));
            }
        }
    }

    #[test]
    fn clipped_polygons_that_are_seen_edge_on_are_drawn_and_culled_nowhere() {
        for culling in [Culling::Back, Culling::Front, Culling::None] {
            let mut scene = scene(&[&RISING.map(|[x, y, z]| [0.0, y, z + 0.5 * x])]);
            scene.culling = culling;
            let frame = frame(&scene);
            let expected = FrameStats {
                clipped: 1,
                edge_on: 1,
                ..counts(1)
            };
            assert_eq!(frame.stats(), expected, "{culling:?}");
            assert_eq!(frame.polygons().len(), 0);
        }
    }

    #[test]
    fn clipped_polygons_seen_from_behind_are_lit_from_behind_if_that_is_asked_for() {
        let normal = DVec3::new(-1.0, 0.0, 1.0).normalize().as_vec3().to_array();
        for (corners, two_sided, toward_eye) in [
            (RISING, false, true),
            (RISING, true, true),
            (reversed(RISING), false, false),
            (reversed(RISING), true, true),
        ] {
            let mut scene = scene(&[&corners]);
            (scene.culling, scene.two_sided) = (Culling::None, two_sided);
            let frame = frame(&scene);
            let polygon = &frame.polygons()[0];
            let expected = normal.map(|n| if toward_eye { n } else { -n });
            assert_eq!(frame.polygon_normal(polygon), expected);
            for &v in frame.corners(polygon) {
                match frame.clip_corner(v) {
                    Some(corner) => {
                        assert_eq!(corner.face, expected);
                        let ends = [corner.a, corner.b].map(|v| frame.normal(v));
                        assert_eq!(ends, [expected; 2]);
                    }
                    None => assert_eq!(frame.normal(v), expected),
                }
            }
        }
    }

    /// The polygon looks as large from the front as from behind: on the picture its lobes cancel.
    #[test]
    fn a_clipped_polygon_of_no_side_is_lit_from_the_front() {
        // On the picture this is an hourglass on its side. The left lobe is in front of the near
        // plane.
        let mut scene = scene(&[&[
            [-1.0, 1.0, -2.0],
            [-1.0, -1.0, -2.0],
            [1.0, 1.0, 0.0],
            [1.0, -1.0, -0.5],
        ]]);
        (scene.culling, scene.two_sided) = (Culling::None, true);
        let frame = frame(&scene);
        assert_eq!(frame.polygons().len(), 1);
        let normal = frame.polygon_normal(&frame.polygons()[0]);
        let mesh = &scene.objects[0].mesh;
        let of_mesh = crate::mesh::newell::polygon_normal(mesh, 0).normalize();
        assert_eq!(normal, of_mesh.as_vec3().to_array());
    }

    #[test]
    fn a_polygon_that_is_beyond_either_of_two_planes_everywhere_is_outside() {
        // Its way from behind the near plane to the left side of the guard band lies outside both.
        let frame = frame(&scene(&[&[
            [0.0, 0.0, 0.0],
            [-1e6, 1.0, -2.0],
            [-1e6, -1.0, -2.0],
        ]]));
        let outside = 1;
        assert_eq!(
            frame.stats(),
            FrameStats {
                outside,
                ..counts(1)
            }
        );
        assert_eq!(frame.polygons().len(), 0);
    }

    /// The upper edge runs from far behind the eye to far in front of it. Its cuts are rounded to
    /// 2⁻⁵³ of its length, which is up to 10⁻³ in depth, to either side of the plane.
    #[test]
    fn polygons_whose_cuts_are_rounded_to_beyond_the_plane_are_not_drawn() {
        let mut unprojected = 0;
        for k in 1..=64 {
            let reach = 1e13 / k as f32;
            let frame = frame(&scene(&[&[
                [-1.0, -1.0, -2.0],
                [1.0, -1.0, -2.0],
                [1.0, 1.0, -2.0 * reach],
                [-1.0, 1.0, reach],
            ]]));
            let is_placed = frame.stats().unprojected == 0;
            let expected = FrameStats {
                unprojected: usize::from(!is_placed),
                clipped: usize::from(is_placed),
                ..counts(1)
            };
            assert_eq!(frame.stats(), expected);
            assert_eq!(frame.polygons().len(), usize::from(is_placed));
            unprojected += frame.stats().unprojected;
        }
        assert!(0 < unprojected && unprojected < 64, "{unprojected}");
    }
}
