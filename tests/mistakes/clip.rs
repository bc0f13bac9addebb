//! Corners of polygons before they are projected, and the planes that cut them.

use crate::camera::{Camera, Seen};
use crate::lighting::Point;
use glam::DVec3;
use std::borrow::Cow;

/// A corner of a polygon before it is projected.
#[derive(Clone, Copy)]
pub struct Vertex {
    pub seen: Seen,
    pub point: Point,
    /// What the student computes at corners: light, or V.
    pub computed: DVec3,
}

/// True if a point is between the near and the far plane.
pub fn is_inside(camera: &Camera, seen: &Seen) -> bool {
    seen.forward >= camera.near && seen.forward <= camera.far
}

/// Cuts a polygon at the near and the far plane.
pub fn clipped<'a>(camera: &Camera, polygon: &'a [Vertex]) -> Cow<'a, [Vertex]> {
    if polygon.iter().all(|v| is_inside(camera, &v.seen)) {
        Cow::Borrowed(polygon)
    } else {
        let part = cut(polygon, |v| v.seen.forward - camera.near);
        Cow::Owned(cut(&part, |v| camera.far - v.seen.forward))
    }
}

/// Returns the part of a polygon where `distance` is 0 or more.
fn cut(polygon: &[Vertex], distance: impl Fn(&Vertex) -> f64) -> Vec<Vertex> {
    let mut part = Vec::with_capacity(polygon.len() + 1);
    for (i, from) in polygon.iter().enumerate() {
        let to = &polygon[(i + 1) % polygon.len()];
        let (a, b) = (distance(from), distance(to));
        if a >= 0.0 {
            part.push(*from);
        }
        if (a >= 0.0) != (b >= 0.0) {
            part.push(mix(from, to, a / (a - b)));
        }
    }
    part
}

/// Returns the point at `t` from `a` to `b`, in space.
fn mix(a: &Vertex, b: &Vertex, t: f64) -> Vertex {
    let number = |p: f64, q: f64| p + (q - p) * t;
    let vector = |p: DVec3, q: DVec3| p + (q - p) * t;
    Vertex {
        seen: Seen {
            right: number(a.seen.right, b.seen.right),
            up: number(a.seen.up, b.seen.up),
            forward: number(a.seen.forward, b.seen.forward),
        },
        point: Point {
            position: vector(a.point.position, b.point.position),
            normal: vector(a.point.normal, b.point.normal),
            length: 1.0,
            view: None,
        },
        computed: vector(a.computed, b.computed),
    }
}
