//! What is computed before the first scanline: once a material, once a vertex, once a polygon.

use crate::frame::Frame;
use crate::number::Machine;
use crate::parallel::for_each_chunk;
use crate::scene::Interpolation;
use crate::shader::{Corner, Corners, Shader};
use crate::walk::Attribute;
use alloc::vec;
use alloc::vec::Vec;

/// A shader's constants by material, attributes by vertex and values by polygon.
pub(super) struct SetUp<S: Shader, M: Machine> {
    pub consts: Vec<S::Consts<M::One>>,
    /// The same constants for the pixel loop.
    pub pixel_consts: Vec<S::Consts<M::F>>,
    pub attributes: Vec<S::Attribute<M::One>>,
    pub polygons: Vec<S::Polygon<M::One>>,
}

impl<S: Shader, M: Machine> SetUp<S, M> {
    pub fn new(m: M, frame: &Frame, parameters: &[u32]) -> Self {
        let consts: Vec<_> = frame.lightings().iter().map(|l| S::consts(l, parameters, &|x| m.one(x))).collect();
        let pixel_consts = frame.lightings().iter().map(|l| S::consts(l, parameters, &|x| m.splat(m.one(x)))).collect();
        let attributes = attributes::<S, M>(m, frame, &consts);
        let polygons = all(frame.polygons().len(), |number| {
            let polygon = &frame.polygons()[number];
            let corners = Corners { machine: m, frame, polygon, attributes: &attributes };
            S::polygon(&consts[polygon.material as usize], &corners)
        });
        SetUp { consts, pixel_consts, attributes, polygons }
    }
}

/// Elements that are computed together on one thread.
const CHUNK: usize = 1 << 13;

/// The values of `of` for 0 to `count` − 1, on several threads.
fn all<T: Copy + Send + Sync>(count: usize, of: impl Fn(usize) -> T + Sync) -> Vec<T> {
    if count <= CHUNK || core::mem::size_of::<T>() == 0 {
        return (0..count).map(of).collect();
    }
    let mut all = vec![of(0); count];
    for_each_chunk(&mut all[..], CHUNK, &|first, part: &mut [T]| {
        part.iter_mut().enumerate().for_each(|(i, value)| *value = of(first + i));
    });
    all
}

/// Vertices are lit; clip corners lie between two of them and are not lit again; then all are weighted by 1/w where
/// attributes are linear in space.
fn attributes<S: Shader, M: Machine>(m: M, frame: &Frame, consts: &[S::Consts<M::One>]) -> Vec<S::Attribute<M::One>> {
    let vertices = frame.vertices();
    let mut all = all(vertices.len(), |number| {
        let vertex = number as u32;
        S::vertex(&consts[frame.material(vertex) as usize], &Corner { machine: m, frame, vertex })
    });
    for corner in frame.clip_corners() {
        let (a, b) = (all[corner.a as usize], all[corner.b as usize]);
        let edge = S::Attribute::edge(m, m.three(corner.face), a, b, m.one(corner.t), m.one(0.0));
        all[corner.vertex as usize] = S::Attribute::at(&edge);
    }
    if frame.interpolation() == Interpolation::Perspective {
        for (attribute, vertex) in all.iter_mut().zip(vertices) {
            *attribute = attribute.weighted(m.one(vertex.inv_w));
        }
    }
    all
}
