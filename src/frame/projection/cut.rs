//! Polygons that reach beyond a plane are cut: the pieces inside are added to the frame.

use super::clip::{Cut, HomogeneousCorner, Plane, clip};
use super::polygons::{Piece, PolygonTable};
use super::side::{Side, eye_side};
use super::view::View;
use super::winding::doubled_area;
use crate::frame::{ClipCorner, Frame};
use crate::scene::{Culling, Interpolation};
use alloc::vec;
use alloc::vec::Vec;
use glam::DMat4;

/// A cutter of polygons, which adds the pieces to the frame.
pub(super) struct Cutting<'a> {
    pub view: &'a View<'a>,
    pub table: &'a PolygonTable,
    pub frame: &'a mut Frame,
    pub pieces: &'a mut Vec<Piece>,
}

impl Cutting<'_> {
    /// Adds the pieces of a polygon that are inside all planes, and counts it as clipped, or as outside if nothing is.
    pub fn polygon(&mut self, polygon: usize) {
        let geometry = self.frame.geometry.clone();
        let (first, count) = self.table.corners(polygon);
        let corners = &geometry.corners[first as usize..][..count as usize];
        let object = &geometry.models.objects[geometry.models.object_of(corners[0] as usize)];
        let matrix = self.view.clip_matrix * DMat4::from(object.transform);
        let clip_position = |&v: &u32| matrix * geometry.models.position(v as usize).extend(1.0);
        let is_behind = eye_side(corners.iter().map(clip_position)) < 0.0;
        let side = if self.view.scene.two_sided && is_behind {
            Side::Back
        } else {
            Side::Front
        };
        let other_side = if side == Side::Back {
            geometry.models.len() as u32
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
        let ends = corners.iter().map(clip_position).zip(&whole);
        let mut pieces = vec![
            ends.map(|(position, &vertex)| HomogeneousCorner { position, vertex })
                .collect::<Vec<_>>(),
        ];
        for plane in self.view.planes {
            let mut inside = Vec::new();
            for piece in &pieces {
                clip(
                    piece,
                    &plane,
                    |cut| self.vertex(cut, &plane, &edge),
                    |part| inside.push(part.to_vec()),
                );
            }
            pieces = inside;
        }
        // Cuts of edges that reach some 10⁹ times as far as they are away may be rounded to beyond the plane that made them.
        let is_placed = |corner: &HomogeneousCorner| self.view.is_on_picture(corner.position);
        if !pieces.iter().flatten().all(is_placed) {
            self.frame.stats.unprojected += 1;
            return;
        }
        match pieces.is_empty() {
            true => self.frame.stats.outside += 1,
            false => self.frame.stats.clipped += 1,
        }
        for piece in pieces {
            let area = doubled_area(piece.iter().map(|c| self.view.snap(c.position)));
            if self.is_drawn(area) {
                self.piece(polygon, side, &whole, &piece);
            }
        }
    }

    /// True if a piece of this signed area on the picture is drawn; counts it if not.
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

    fn piece(&mut self, polygon: usize, side: Side, whole: &[u32], corners: &[HomogeneousCorner]) {
        debug_assert!(corners.len() >= 3, "clipping leaves polygons");
        let mean = self.frame.mean_of(whole);
        let frame = &mut *self.frame;
        let first = (frame.geometry.corners.len() + frame.cut_corners.len()) as u32;
        frame.means.push((first, mean));
        frame
            .cut_corners
            .extend(corners.iter().map(|corner| corner.vertex));
        let (source, count) = (polygon as u32, corners.len() as u32);
        self.pieces.push(Piece {
            source,
            first,
            count,
            is_back: side == Side::Back,
        });
    }

    /// Makes the vertex where a plane cuts an edge: its attributes lie between those of the edge's ends.
    fn vertex(&mut self, cut: &Cut, plane: &Plane, edge: &EdgeOf) -> u32 {
        let number = self.frame.vertices.len() as u32;
        self.frame.vertices.push(self.view.vertex(cut.position));
        self.frame.cut_materials.push(edge.material);
        // Attributes that are linear on the screen are divided there, where both ends have a place on it.
        let on_screen = self.view.scene.interpolation == Interpolation::Screen && plane.in_front;
        let t = if on_screen { cut.t_on_screen() } else { cut.t };
        let (a, b) = (cut.a.vertex, cut.b.vertex);
        debug_assert!(
            a.max(b) < number,
            "the ends of an edge are numbered before its cuts"
        );
        self.frame.clip_corners.push(ClipCorner {
            vertex: number,
            a,
            b,
            t: t as f32,
            face: edge.face,
        });
        number
    }
}

/// The attributes that a vertex on an edge takes from the edge's polygon.
struct EdgeOf {
    material: u32,
    face: [f32; 3],
}
