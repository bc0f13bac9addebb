//! The set-up before the first scanline: uniforms once per material, and once per polygon where each sees other light; then vertices, corners or polygons are lit, each once, by the
//! method's vertex kernel, on all threads. The loop over them is `light` in `shading/kernels.rs`.

use crate::frame::{ClipCorner, Frame, Polygon};
use crate::number::parallel::for_each_chunk;
use crate::number::{BLOCK, Level, Vec3, vec3};
use crate::scene::Interpolation;
use crate::shading::increments::GreatCircle;
use crate::shading::lighting::Uniforms;
use crate::shading::{
    Extras, Kernels, LitAt, Local, Perspective, Pixels, Run, UniformsIndex, Variant, VertexKernel,
    Vertices, ramp,
};
use alloc::borrow::Cow;
use alloc::vec;
use alloc::vec::Vec;

/// The element that a varying belongs to.
#[derive(Clone, Debug)]
pub(super) enum Per {
    /// A vertex, by its number.
    Vertex,
    /// A corner of a polygon, where light is seen from the polygon: by the number of the polygon's first corner and its own.
    Corner(Vec<u32>),
    /// A polygon, by its number: nothing is interpolated.
    Polygon,
}

/// Numbers that are interpolated, or that hold over polygons.
#[derive(Clone, Debug)]
pub(super) struct Varyings<'a> {
    pub values: Cow<'a, [f32]>,
    /// Numbers of each varying.
    pub count: usize,
    pub per: Per,
    /// True for unit normals, which walk great circles.
    pub great_circle: bool,
}

impl<'a> Varyings<'a> {
    /// Takes `count` numbers per vertex, interpolated linearly.
    pub fn of_vertices(values: impl Into<Cow<'a, [f32]>>, count: usize) -> Self {
        Varyings {
            values: values.into(),
            count,
            per: Per::Vertex,
            great_circle: false,
        }
    }

    /// Returns no numbers, for engines that only find what is visible.
    pub fn none() -> Self {
        Varyings::of_vertices(&[][..], 0)
    }

    /// Returns the numbers of corner `corner` of polygon `number`, whose vertex is `vertex`.
    #[inline(always)]
    pub fn of_corner(&self, number: u32, corner: u32, vertex: u32) -> &[f32] {
        let place = match &self.per {
            Per::Vertex => vertex,
            Per::Corner(first) => first[number as usize] + corner,
            Per::Polygon => number,
        };
        &self.values[place as usize * self.count..][..self.count]
    }

    /// Returns the numbers of polygon `number`, if they hold over all of it.
    #[inline(always)]
    pub fn of_polygon(&self, number: u32) -> Option<&[f32]> {
        match self.per {
            Per::Polygon => Some(self.of_corner(number, 0, 0)),
            _ => None,
        }
    }
}

/// A method on a frame, ready to be drawn.
pub(super) struct SetUp<'a> {
    pub frame: &'a Frame,
    pub kernels: &'static Kernels,
    pub parameters: &'a [u32],
    pub extras: Extras,
    /// Those of the polygons, where each sees light and eye at positions from its own place; then those of the materials. The
    /// numbers of polygons come first, so that the row engine, which stores them as floats, has exact ones.
    pub uniforms: Vec<Uniforms>,
    /// True if each polygon has uniforms of its own.
    pub is_by_polygon: bool,
    pub varyings: Varyings<'a>,
    /// Lights vertices on the instruction set of the engine.
    light: VertexKernel,
}

/// Vertices that are lit by one call.
const BATCH: usize = 64;
/// Vertices that are lit on one thread.
const CHUNK: usize = 1 << 13;

/// A vertex to be lit: its uniforms, normal and position.
type Item = (UniformsIndex, [f32; 3], [f32; 3]);

impl<'a> SetUp<'a> {
    /// Computes uniforms and varyings of a method on a frame: on an instruction set, with colours multiplied by a scale, in memory
    /// whose contents do not matter.
    pub fn new(variant: &'a Variant, frame: &'a Frame, how: (Level, f32, Vec<f32>)) -> Self {
        let (level, scale, memory) = how;
        let (entry, info, near) = (variant.entry(), variant.info(), frame.is_local());
        let kernels = entry.kernels(frame.light_count(), near);
        let is_perspective = frame.interpolation() == Interpolation::Perspective;
        let lightings = frame.lightings().iter();
        let mut uniforms: Vec<Uniforms> = lightings.map(|l| Uniforms::new(l, scale)).collect();
        let is_by_polygon = near && info.local == Local::PerPolygon;
        if is_by_polygon {
            let polygons = frame.polygons().iter();
            let seen =
                |p: &Polygon| uniforms[p.material as usize].seen_from(frame.mean(p).position);
            let by_polygon: Vec<Uniforms> = polygons.map(seen).collect();
            uniforms.splice(..0, by_polygon);
        }
        let extras = entry.extras(near, is_perspective);
        let vertices = (kernels.simd)(level).and_then(|simd| simd.vertices);
        let [own, _] = (kernels.counts)(frame.light_count());
        let mut varyings = Varyings::of_vertices(&[][..], own + extras.count());
        varyings.great_circle = kernels.great_circle;
        let mut all = SetUp {
            frame,
            kernels,
            parameters: variant.parameters(),
            extras,
            uniforms,
            is_by_polygon,
            varyings,
            light: vertices.unwrap_or(kernels.vertices),
        };
        let is_weighted =
            is_perspective && matches!(info.perspective, Perspective::Free | Perspective::Divides);
        (all.varyings.values, all.varyings.per) = match info.lit_at {
            LitAt::Polygon | LitAt::PolygonMean => all.light_polygons(info.lit_at),
            _ if is_by_polygon && !kernels.great_circle => all.light_corners(is_weighted),
            _ => all.light_vertices(is_weighted, memory),
        };
        all
    }

    /// Returns the number of the uniforms of a polygon.
    #[inline(always)]
    pub fn uniforms_of(&self, number: u32) -> UniformsIndex {
        match self.is_by_polygon {
            true => UniformsIndex(number),
            false => UniformsIndex(self.frame.polygons()[number as usize].material),
        }
    }

    /// Returns the number of the uniforms of a material, as vertices have them that no polygon lights.
    #[inline(always)]
    pub fn uniforms_of_material(&self, material: u32) -> UniformsIndex {
        debug_assert!(
            (material as usize) < self.frame.lightings().len(),
            "a material and not a polygon"
        );
        let before = match self.is_by_polygon {
            true => self.frame.polygons().len() as u32,
            false => 0,
        };
        UniformsIndex(before + material)
    }

    /// Returns the job of a kernel that shades runs, or walks along them.
    pub fn pixels<'p>(&'p self, runs: &'p [Run], starts: &'p [f32]) -> Pixels<'p> {
        Pixels {
            parameters: self.parameters,
            uniforms: &self.uniforms,
            extras: self.extras,
            runs,
            starts,
        }
    }

    /// Lights every vertex, or borrows the frame's normals where a method interpolates nothing else.
    fn light_vertices(&self, is_weighted: bool, memory: Vec<f32>) -> (Cow<'a, [f32]>, Per) {
        let (frame, count, near) = (self.frame, self.varyings.count, self.frame.is_local());
        let has_one_material = frame.lightings().len() == 1;
        let normals = frame.normals_on_screen();
        let alone = normals.filter(|_| self.extras == Extras::default());
        if let Some(normals) = alone.filter(|_| self.kernels.passes_normal) {
            return (normals.as_flattened().into(), Per::Vertex);
        }
        // Normals of one material need not be gathered.
        let ready = alone.filter(|_| has_one_material && !near);
        let item = |i: usize| {
            let vertex = i as u32;
            let point = match near {
                true => frame.position(vertex),
                false => [0.0; 3],
            };
            // The only material need not be read.
            let material = (!has_one_material).then(|| frame.material(vertex));
            let uniforms = self.uniforms_of_material(material.unwrap_or(0));
            (uniforms, frame.normal(vertex), point)
        };
        let mut values = self.lit(memory, frame.vertices().len(), ready.unwrap_or(&[]), &item);
        let great_circle = self.varyings.great_circle;
        finish(frame, &mut values, (count, great_circle), is_weighted);
        (values.into(), Per::Vertex)
    }

    /// Lights each polygon once.
    fn light_polygons(&self, at: LitAt) -> (Cow<'a, [f32]>, Per) {
        let frame = self.frame;
        let item = |number: usize| {
            let polygon = &frame.polygons()[number];
            let normal = match at {
                LitAt::PolygonMean => vec3(frame.mean(polygon).normal).unit().array(),
                _ => frame.polygon_normal(polygon),
            };
            (self.uniforms_of(number as u32), normal, [0.0; 3])
        };
        let values = self.lit(Vec::new(), frame.polygons().len(), &[], &item);
        (values.into(), Per::Polygon)
    }

    /// Lights the corners of each polygon by the light that the polygon sees.
    fn light_corners(&self, is_weighted: bool) -> (Cow<'a, [f32]>, Per) {
        let (frame, count) = (self.frame, self.varyings.count);
        let (mut first, mut corners) = (Vec::new(), Vec::new());
        for (number, polygon) in (0..).zip(frame.polygons()) {
            first.push(corners.len() as u32);
            let vertices = frame.corners(polygon).iter();
            corners.extend(vertices.map(|&vertex| (number, vertex)));
        }
        let item = |i: usize| {
            let (number, vertex) = corners[i];
            (self.uniforms_of(number), frame.normal(vertex), [0.0; 3])
        };
        let mut values = self.lit(Vec::new(), corners.len(), &[], &item);
        for (&(number, vertex), to) in corners.iter().zip(values.chunks_exact_mut(count)) {
            if frame.clip_corner(vertex).is_some() {
                to.copy_from_slice(&self.clipped(number, vertex));
            }
            if is_weighted {
                let weight = frame.vertices()[vertex as usize].inv_w;
                to.iter_mut().for_each(|value| *value *= weight);
            }
        }
        (values.into(), Per::Corner(first))
    }

    /// Returns the varying of a vertex on polygon `number`: between the ends of the edge on which clipping made it, or lit.
    fn clipped(&self, number: u32, vertex: u32) -> Vec<f32> {
        let Some(corner) = self.frame.clip_corner(vertex) else {
            let item = |_| {
                (
                    self.uniforms_of(number),
                    self.frame.normal(vertex),
                    [0.0; 3],
                )
            };
            return self.lit(Vec::new(), 1, &[], &item);
        };
        let ends = [corner.a, corner.b].map(|v| self.clipped(number, v));
        let mut to = vec![0.0; self.varyings.count];
        between(self.varyings.great_circle, &corner, &ends, &mut to);
        to
    }

    /// Lights `count` vertices, on several threads and on an instruction set: in whole blocks, as kernels may take no others. What
    /// `values` holds before does not matter. If they are all of the first material and without extras, their normals may be
    /// `ready` in a row.
    fn lit(
        &self,
        mut values: Vec<f32>,
        count: usize,
        ready: &[[f32; 3]],
        item: &(dyn Fn(usize) -> Item + Sync),
    ) -> Vec<f32> {
        let (stride, extras) = (self.varyings.count, self.extras);
        let own = stride - extras.count();
        debug_assert!(
            ready.is_empty() || ready.len() == count && extras == Extras::default(),
            "normals in a row are those of all vertices, and have nothing beside them"
        );
        values.resize(count * stride, 0.0);
        // Without varyings the chunks have a size all the same.
        let size = CHUNK * stride.max(1);
        for_each_chunk(&mut values[..], size, &|first, mut rest: &mut [f32]| {
            let mut first = first / stride;
            if !ready.is_empty() {
                let whole = rest.len() / stride / BLOCK * BLOCK;
                let normals = &ready[first..first + whole];
                let (here, others) = rest.split_at_mut(whole * stride);
                // Directional lights do not ask for points.
                self.light(self.uniforms_of_material(0), normals, normals, here);
                (rest, first) = (others, first + whole);
            }
            let (mut normals, mut points) = ([[0.0; 3]; BATCH], [[0.0; 3]; BATCH]);
            let mut lit = vec![0.0; BATCH * own];
            while !rest.is_empty() {
                let most = BATCH.min(rest.len() / stride);
                let (number, mut k) = (item(first).0, 0);
                while k < most {
                    let (other, normal, point) = item(first + k);
                    if other != number {
                        break;
                    }
                    (normals[k], points[k]) = (normal, point);
                    k += 1;
                }
                let padded = k.next_multiple_of(BLOCK);
                let to = &mut lit[..padded * own];
                self.light(number, &normals[..padded], &points[..padded], to);
                let (here, others) = rest.split_at_mut(k * stride);
                // The house's extras stand behind the varyings of the method.
                for (k, to) in here.chunks_exact_mut(stride).enumerate() {
                    to[..own].copy_from_slice(&lit[k * own..][..own]);
                    if extras.point {
                        to[own..own + 3].copy_from_slice(&points[k]);
                    }
                    if extras.weight {
                        to[stride - 1] = 1.0;
                    }
                }
                (rest, first) = (others, first + k);
            }
        });
        values
    }

    /// Lights vertices of the same uniforms.
    fn light(
        &self,
        uniforms: UniformsIndex,
        normals: &[[f32; 3]],
        points: &[[f32; 3]],
        to: &mut [f32],
    ) {
        debug_assert_eq!(normals.len(), points.len(), "a position a normal");
        let vertices = Vertices {
            parameters: self.parameters,
            uniforms: &self.uniforms[uniforms.0 as usize],
            normals,
            points,
        };
        (self.light)(&vertices, to);
    }
}

/// Stores what a corner that clipping made carries: what lies between the ends of its edge, which are never lit again.
fn between(great_circle: bool, corner: &ClipCorner, ends: &[Vec<f32>; 2], to: &mut [f32]) {
    let [a, b] = ends;
    if great_circle {
        let normals = [unit(a), unit(b)];
        let circle = GreatCircle::new(vec3(corner.face), normals, corner.t, 0.0);
        to.copy_from_slice(&circle.normal().array());
        return;
    }
    for ((to, a), b) in to.iter_mut().zip(a).zip(b) {
        [*to, _] = ramp(*a, *b, corner.t, 0.0);
    }
}

/// Fills in the `values` per vertex of the corners that clipping made, and multiplies all by the weights of perspective if
/// `is_weighted`.
pub(super) fn finish(
    frame: &Frame,
    values: &mut [f32],
    (count, great_circle): (usize, bool),
    is_weighted: bool,
) {
    for corner in frame.clip_corners() {
        debug_assert!(
            corner.a.max(corner.b) < corner.vertex,
            "a cut is finished after the ends of its edge"
        );
        let ends = [corner.a, corner.b].map(|v| values[v as usize * count..][..count].to_vec());
        let to = &mut values[corner.vertex as usize * count..][..count];
        between(great_circle, corner, &ends, to);
    }
    if is_weighted && count > 0 {
        for (varying, vertex) in values.chunks_exact_mut(count).zip(frame.vertices()) {
            varying.iter_mut().for_each(|value| *value *= vertex.inv_w);
        }
    }
}

/// Returns the normal that numbers begin with.
pub(super) fn unit(numbers: &[f32]) -> Vec3<f32> {
    vec3([numbers[0], numbers[1], numbers[2]])
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::builtin::builtin;
    use crate::scene::Scene;

    /// An engine reads the frame's normals in place of varyings where they are the same, and nowhere else.
    #[test]
    fn normals_stand_for_varyings_only_where_they_are_the_same() {
        type Case = (fn(&mut Scene), bool);
        let cases: [Case; 5] = [
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
            (|scene| scene.local_viewer = true, false),
        ];
        for (change, is_there) in cases {
            let mesh = builtin("sphere?rings=12&segments=24&triangles=true");
            let mut scene = Scene::of_mesh(mesh.expect("a built-in mesh"));
            change(&mut scene);
            let frame = scene.frame().expect("a scene in its range");
            for method in ["naive-phong", "phong-rsqrt"] {
                let variant = Variant::parse(method).expect("a method");
                let setup = SetUp::new(&variant, &frame, (Level::Scalar, 1.0, Vec::new()));
                let Varyings { values, count, .. } = &setup.varyings;
                let is_borrowed = matches!(values, Cow::Borrowed(_));
                assert_eq!(is_borrowed, is_there);
                let clipped = |v: u32| frame.clip_corner(v).is_some();
                let vertices = (0..).zip(frame.vertices()).filter(|(v, _)| !clipped(*v));
                for (number, vertex) in vertices {
                    let weight = match scene.interpolation {
                        Interpolation::Perspective => vertex.inv_w,
                        Interpolation::Screen => 1.0,
                    };
                    let expected = frame.normal(number).map(|x| x * weight);
                    assert_eq!(values[number as usize * count..][..3], expected, "{number}");
                }
            }
        }
    }
}
