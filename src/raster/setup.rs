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
        Self::with(m, frame, parameters, attributes::<S, M>)
    }

    /// Likewise, without attributes: for shaders that have no values by polygon, where attributes are read elsewhere.
    pub fn without_attributes(m: M, frame: &Frame, parameters: &[u32]) -> Self {
        const { assert!(!S::ATTRIBUTE_IS_NORMAL || core::mem::size_of::<S::Polygon<f32>>() == 0) };
        Self::with(m, frame, parameters, |_, _, _| Vec::new())
    }

    /// Likewise, with what `attributes` makes of the constants.
    fn with(
        m: M,
        frame: &Frame,
        parameters: &[u32],
        attributes: impl FnOnce(M, &Frame, &[S::Consts<M::One>]) -> Vec<S::Attribute<M::One>>,
    ) -> Self {
        let consts: Vec<_> = frame
            .lightings()
            .iter()
            .map(|l| S::consts(l, parameters, &|x| m.one(x)))
            .collect();
        let pixel_consts = frame
            .lightings()
            .iter()
            .map(|l| S::consts(l, parameters, &|x| m.splat(m.one(x))))
            .collect();
        let attributes = attributes(m, frame, &consts);
        let polygons = all(frame.polygons().len(), |number| {
            let polygon = &frame.polygons()[number];
            let corners = Corners {
                machine: m,
                frame,
                polygon,
                attributes: &attributes,
            };
            S::polygon(&consts[polygon.material as usize], &corners)
        });
        SetUp {
            consts,
            pixel_consts,
            attributes,
            polygons,
        }
    }
}

/// Elements that are computed together on one thread.
const CHUNK: usize = 1 << 13;

/// The values of `of` for 0 to `count` − 1, on several threads.
fn all<T: Copy + Send + Sync>(count: usize, of: impl Fn(usize) -> T + Sync) -> Vec<T> {
    if count == 0 {
        return Vec::new();
    }
    let mut all = vec![value(0, &of); count];
    // Where a value has no size there is only one.
    if core::mem::size_of::<T>() != 0 {
        for_each_chunk(&mut all[1..], CHUNK, &|first, part: &mut [T]| {
            part.iter_mut()
                .enumerate()
                .for_each(|(i, value)| *value = of(1 + first + i));
        });
    }
    all
}

/// The value of `of` for `i`: not inlined, as what it is made of is inlined into the loop over all others.
#[inline(never)]
fn value<T>(i: usize, of: &impl Fn(usize) -> T) -> T {
    of(i)
}

/// Vertices are lit; clip corners lie between two of them and are not lit again; then all are weighted by 1/w where
/// attributes are linear in space.
fn attributes<S: Shader, M: Machine>(
    m: M,
    frame: &Frame,
    consts: &[S::Consts<M::One>],
) -> Vec<S::Attribute<M::One>> {
    let vertices = frame.vertices();
    let mut all = all(vertices.len(), |number| {
        let vertex = number as u32;
        // Where there is one material, whose a vertex is need not be read.
        let consts = if let [only] = consts {
            only
        } else {
            &consts[frame.material(vertex) as usize]
        };
        S::vertex(
            consts,
            &Corner {
                machine: m,
                frame,
                vertex,
            },
        )
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::builtin::builtin;
    use crate::number::Scalar;
    use crate::scene::Scene;
    use crate::shader::{Method, NaivePhong, PhongRsqrt};

    /// What an engine reads in place of attributes is what they are; and it is not there where they are something else.
    #[test]
    fn normals_stand_for_attributes_only_where_they_are_the_same() {
        fn check<S: Shader<Attribute<f32> = crate::walk::Lerp<[f32; 3]>>>(
            change: fn(&mut Scene),
            is_there: bool,
        ) {
            let mut scene = Scene::of_mesh(
                builtin("sphere?rings=12&segments=24&triangles=true").expect("a built-in mesh"),
            );
            change(&mut scene);
            let frame = scene.frame().expect("a scene in its range");
            let attributes = SetUp::<S, Scalar>::new(Scalar, &frame, &[]).attributes;
            let normals = frame.normals_on_screen();
            assert_eq!(normals.is_some(), is_there);
            let same = |normals: &[[f32; 3]]| {
                normals
                    .iter()
                    .eq(attributes.iter().map(|attribute| &attribute.0))
            };
            assert!(S::ATTRIBUTE_IS_NORMAL && normals.is_none_or(same));
        }
        type Case = (fn(&mut Scene), bool);
        let cases: [Case; 4] = [
            (|_| (), true),
            (|scene| scene.two_sided = true, false),
            (
                |scene| scene.interpolation = Interpolation::Perspective,
                false,
            ),
            // The near plane cuts the sphere.
            (
                |scene| scene.camera.near = (scene.camera.eye - scene.camera.target).length(),
                false,
            ),
        ];
        for (change, is_there) in cases {
            check::<<NaivePhong as Method>::Screen<1>>(change, is_there);
            check::<<PhongRsqrt as Method>::Screen<1>>(change, is_there);
        }
    }
}
