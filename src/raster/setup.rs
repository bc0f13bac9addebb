//! The set-up before the first scanline. First it computes uniforms, once per material, or once per
//! polygon where each polygon sees light from its own place. Then the method's vertex kernel lights
//! vertices, corners or polygons, each once. All of this runs on all threads. The loop over
//! vertices is `light` in `shading/kernels/mod.rs`.

use crate::frame::{ClipCorner, Frame, Polygon};
use crate::number::parallel::for_each_chunk;
use crate::number::{BLOCK, SimdLevel, Vec3, vec3};
use crate::scene::Interpolation;
use crate::shading::light::Uniforms;
#[cfg(feature = "simd")]
use crate::shading::methods;
use crate::shading::walks::GreatCircle;
use crate::shading::{
    Carried, Corner, Corners, Extras, Kernels, Local, Pixels, PolygonConstants, RunList,
    ShadingRate, UniformsIndex, Value, Variant, VertexKernel, Vertices, ramp,
};
use alloc::borrow::Cow;
use alloc::vec;
use alloc::vec::Vec;

/// The kind of element that a varying belongs to.
#[derive(Clone, Debug)]
pub(super) enum Per {
    /// A vertex: one varying per index of a vertex.
    Vertex,
    /// A corner of a polygon, where each polygon sees light from its own place. A corner's varying
    /// is at the index stored here for its polygon, plus the corner's place in the polygon.
    Corner(Vec<u32>),
    /// A polygon: one varying per index of a polygon, and nothing is interpolated.
    Polygon,
}

/// Values that are interpolated over polygons, or constant over them.
#[derive(Clone, Debug)]
pub(super) struct Varyings<'a> {
    pub values: Cow<'a, [f32]>,
    /// How many values each varying has.
    pub count: usize,
    pub per: Per,
    /// True for unit normals that edges carry along great circles. Extras may follow the normal.
    pub great_circles: bool,
    /// True if runs start from the varyings at both ends of their spans, and store their places
    /// there.
    pub keeps_ends: bool,
}

impl<'a> Varyings<'a> {
    /// Makes varyings of `count` values per vertex, interpolated linearly.
    pub fn of_vertices(values: impl Into<Cow<'a, [f32]>>, count: usize) -> Self {
        Varyings {
            values: values.into(),
            count,
            per: Per::Vertex,
            great_circles: false,
            keeps_ends: false,
        }
    }

    /// Makes empty varyings, for engines that only find which polygon is visible.
    pub fn none() -> Self {
        Varyings::of_vertices(&[][..], 0)
    }

    /// Returns the values of corner `corner` of `polygon`, whose vertex is `vertex`.
    #[inline(always)]
    pub fn of_corner(&self, polygon: u32, corner: u32, vertex: u32) -> &[f32] {
        self.of_corner_with(self.count, polygon, [corner, vertex])
    }

    /// Returns the same values as [`Varyings::of_corner`]. `count` must equal [`Varyings::count`];
    /// callers pass a literal, so that the compiler unrolls loops over the values.
    #[inline(always)]
    pub fn of_corner_with(&self, count: usize, polygon: u32, [corner, vertex]: [u32; 2]) -> &[f32] {
        debug_assert_eq!(count, self.count, "all values of the corner");
        let place = match &self.per {
            Per::Vertex => vertex,
            Per::Corner(first) => first[polygon as usize] + corner,
            Per::Polygon => polygon,
        };
        &self.values[place as usize * count..][..count]
    }

    /// Returns the values of `polygon`, if they are constant over it.
    #[inline(always)]
    pub fn of_polygon(&self, polygon: u32) -> Option<&[f32]> {
        match self.per {
            Per::Polygon => Some(self.of_corner(polygon, 0, 0)),
            _ => None,
        }
    }
}

/// A method on a frame, ready to draw.
pub(super) struct SetUp<'a> {
    pub frame: &'a Frame,
    pub kernels: &'static Kernels,
    pub parameters: &'a [Value],
    pub extras: Extras,
    /// The uniforms of the polygons, if each polygon sees light and eye at positions from its own
    /// place; behind them the uniforms of the materials. Polygons come first because the row engine
    /// stores indices as floats, and small ones are exact.
    pub uniforms: Vec<Uniforms>,
    /// True if each polygon has its own uniforms.
    pub is_by_polygon: bool,
    pub varyings: Varyings<'a>,
    /// The constants that the method computes for each polygon.
    constants: PolygonConstants,
    /// Lights vertices, on the engine's instruction set.
    light: VertexKernel,
}

/// How many vertices one call lights.
const BATCH: usize = 64;
/// How many vertices one thread lights at a time.
const CHUNK: usize = 1 << 13;

/// A vertex to be lit.
#[derive(Clone, Copy)]
struct Item {
    uniforms: UniformsIndex,
    normal: [f32; 3],
    position: [f32; 3],
    /// The vertex's attributes, if the method or its material reads them.
    attributes: [f32; 4],
}

impl<'a> SetUp<'a> {
    /// Computes the uniforms and varyings of a method on a frame, on instruction set `level`.
    /// Colours are multiplied by `scale`. The varyings reuse `memory`, whose contents do not
    /// matter.
    pub fn new(
        variant: &'a Variant,
        frame: &'a Frame,
        level: SimdLevel,
        scale: f32,
        memory: Vec<f32>,
    ) -> Self {
        let row = variant.row().on(frame);
        let kernels = row.kernels(frame.light_count(), frame.is_local());
        SetUp::by(kernels, variant, frame, level, scale, memory)
    }

    /// Computes them with these kernels of the method, which may be compiled for more lights than
    /// the frame has.
    pub fn by(
        kernels: &'static Kernels,
        variant: &'a Variant,
        frame: &'a Frame,
        level: SimdLevel,
        scale: f32,
        memory: Vec<f32>,
    ) -> Self {
        let (entry, is_local) = (variant.row().on(frame), frame.is_local());
        let is_perspective = frame.interpolation() == Interpolation::Perspective;
        let lightings = frame.lightings().iter();
        let mut uniforms: Vec<Uniforms> = lightings.map(|l| variant.uniforms(l, scale)).collect();
        let is_by_polygon = is_local && entry.needs.local == Local::PerPolygon;
        if is_by_polygon {
            uniforms = by_polygon(frame, uniforms);
        }
        let extras = entry.extras(is_local, is_perspective, frame.is_coloured());
        let vertices = (kernels.simd)(level).and_then(|simd| simd.vertices);
        let [own, ..] = (kernels.counts)(frame.light_count());
        let mut varyings = Varyings::of_vertices(&[][..], own + extras.count());
        varyings.great_circles = kernels.needs.great_circles();
        varyings.keeps_ends = kernels.needs.reads_span();
        let mut all = SetUp {
            frame,
            kernels,
            parameters: variant.parameters(),
            extras,
            uniforms,
            is_by_polygon,
            varyings,
            constants: PolygonConstants::default(),
            light: vertices.unwrap_or(kernels.vertices),
        };
        let is_weighted = is_perspective && entry.needs.perspective.is_weighted();
        (all.varyings.values, all.varyings.per) = match entry.needs.shading_rate {
            ShadingRate::Polygon | ShadingRate::PolygonMean => {
                all.light_polygons(entry.needs.shading_rate, memory)
            }
            _ if is_by_polygon && !kernels.needs.great_circles() => {
                all.light_corners(is_weighted, memory)
            }
            _ => all.light_vertices(is_weighted, memory),
        };
        all.constants = all.set_up_polygons();
        all
    }

    /// Returns a set-up without varyings and light, to find depths only. Its method shades nothing.
    #[cfg(feature = "simd")]
    pub fn of_depths(frame: &'a Frame) -> Self {
        let kernels = methods::FLAT.kernels(frame.light_count(), false);
        SetUp {
            frame,
            kernels,
            parameters: &[],
            extras: Extras::default(),
            uniforms: Vec::new(),
            is_by_polygon: true,
            varyings: Varyings::none(),
            constants: PolygonConstants::default(),
            light: kernels.vertices,
        }
    }

    /// Computes the method's constants for every polygon, if it has any.
    fn set_up_polygons(&self) -> PolygonConstants {
        let (frame, mut constants) = (self.frame, PolygonConstants::default());
        let [_, _, count] = (self.kernels.counts)(frame.light_count());
        let has_kinds = !self.kernels.kinds.is_empty();
        if count == 0 && !has_kinds {
            return constants;
        }
        // Each polygon has one record, its kind and then its values. So threads share a single
        // list.
        let polygons = frame.polygons();
        let stride = 1 + count;
        let mut records = vec![0.0; polygons.len() * stride];
        for_each_chunk(
            &mut records[..],
            CHUNK * stride,
            &|first, records: &mut [f32]| {
                let (mut corners, mut whole) = (Vec::new(), Vec::new());
                for (index, record) in (first / stride..).zip(records.chunks_exact_mut(stride)) {
                    let polygon = self.corners_of(&polygons[index], &mut corners, &mut whole);
                    let uniforms = &self.uniforms[self.uniforms_of(index as u32).0 as usize];
                    let kind = (self.kernels.polygon)(
                        self.parameters,
                        uniforms,
                        &polygon,
                        &mut record[1..],
                    );
                    record[0] = f32::from(kind);
                }
            },
        );
        constants.values.reserve_exact(polygons.len() * count);
        for record in records.chunks_exact(stride) {
            if has_kinds {
                constants.kinds.push(record[0] as u8);
            }
            constants.values.extend_from_slice(&record[1..]);
        }
        constants
    }

    /// Returns a polygon as methods read it. Its lists live in `corners` and `whole`, which are
    /// overwritten.
    fn corners_of<'c>(
        &self,
        polygon: &Polygon,
        corners: &'c mut Vec<Corner<f32>>,
        whole: &'c mut Vec<Vec3<f32>>,
    ) -> Corners<'c, f32> {
        let frame = self.frame;
        corners.clear();
        whole.clear();
        for &corner in frame.corners(polygon) {
            let vertex = &frame.vertices()[corner as usize];
            corners.push(Corner {
                normal: vec3(frame.normal(corner)),
                // Exact: coordinates have at most 24 bits.
                place: [vertex.x, vertex.y].map(|at| at.to_bits() as f32 * (1.0 / 256.0)),
                weight: frame.weight(corner),
                position: vec3(frame.position(corner)),
            });
            self.collect_whole(corner, whole);
        }
        Corners {
            face: vec3(frame.polygon_normal(polygon)),
            is_whole: frame
                .corners(polygon)
                .iter()
                .all(|&v| frame.clip_corner(v).is_none()),
            // The mean of the polygon's own corners is computed here, which is simple enough for a
            // loop over all polygons.
            mean: match frame.stated_mean(polygon) {
                Some(mean) => vec3(mean.normal),
                None => {
                    let sum = corners.iter().fold(vec3([0.0; 3]), |sum, c| sum + c.normal);
                    sum * (1.0 / corners.len() as f32)
                }
            },
            all: corners,
            whole,
        }
    }

    /// Collects the normals of the scene's own vertices between which a corner's normal lies: the
    /// corner's own normal, or the normals at both ends of the edge on which clipping made the
    /// corner.
    fn collect_whole(&self, corner: u32, whole: &mut Vec<Vec3<f32>>) {
        match self.frame.clip_corner(corner) {
            None => whole.push(vec3(self.frame.normal(corner))),
            // An end of the edge may itself be a corner that another plane made.
            Some(cut) => {
                self.collect_whole(cut.a, whole);
                self.collect_whole(cut.b, whole);
            }
        }
    }

    /// Returns the kind of each polygon; empty if the method has no kinds.
    pub fn kinds(&self) -> &[u8] {
        &self.constants.kinds
    }

    /// Returns the index of a polygon's uniforms.
    #[inline(always)]
    pub fn uniforms_of(&self, polygon: u32) -> UniformsIndex {
        if self.is_by_polygon {
            UniformsIndex(polygon)
        } else {
            UniformsIndex(self.frame.polygons()[polygon as usize].material)
        }
    }

    /// Returns the index of a material's uniforms, which vertices use that are lit without regard
    /// to their polygon.
    #[inline(always)]
    pub fn uniforms_of_material(&self, material: u32) -> UniformsIndex {
        debug_assert!(
            (material as usize) < self.frame.lightings().len(),
            "a material and not a polygon"
        );
        let before = if self.is_by_polygon {
            self.frame.polygons().len() as u32
        } else {
            0
        };
        UniformsIndex(before + material)
    }

    /// Returns the job for a kernel that shades runs or walks along them.
    pub fn pixels<'p>(&'p self, list: &'p RunList) -> Pixels<'p> {
        Pixels {
            parameters: self.parameters,
            uniforms: &self.uniforms,
            extras: self.extras,
            constants: &self.constants,
            list,
        }
    }

    /// Lights every vertex, or borrows the frame's normals if the method interpolates nothing else.
    fn light_vertices(&self, is_weighted: bool, memory: Vec<f32>) -> (Cow<'a, [f32]>, Per) {
        let (frame, count, is_local) = (self.frame, self.varyings.count, self.frame.is_local());
        let has_one_material = frame.lightings().len() == 1;
        let normals = frame.normals_on_screen();
        let alone = normals.filter(|_| self.extras == Extras::default());
        if let Some(normals) = alone.filter(|_| self.passes_normals()) {
            return (normals.as_flattened().into(), Per::Vertex);
        }
        // With a single material the normals need not be gathered.
        let reads_attributes = self.reads_attributes();
        let ready = alone.filter(|_| has_one_material && !is_local && !reads_attributes);
        let item = |i: usize| {
            let vertex = i as u32;
            let point = if is_local {
                frame.position(vertex)
            } else {
                [0.0; 3]
            };
            // With a single material its index need not be read.
            let material = (!has_one_material).then(|| frame.material(vertex));
            Item {
                uniforms: self.uniforms_of_material(material.unwrap_or(0)),
                normal: frame.normal(vertex),
                position: point,
                attributes: self.attributes(vertex),
            }
        };
        let mut values = self.lit(memory, frame.vertices().len(), ready.unwrap_or(&[]), &item);
        let great_circle = self.varyings.great_circles;
        finish(frame, &mut values, count, great_circle, is_weighted);
        (values.into(), Per::Vertex)
    }

    /// True if the varyings are the frame's normals. Where edges follow great circles they are not:
    /// clipping then puts its corners' normals on the circle.
    fn passes_normals(&self) -> bool {
        self.kernels.carries == Carried::Normal && !self.varyings.great_circles
    }

    /// True if the method or a material reads the attributes of vertices.
    fn reads_attributes(&self) -> bool {
        self.kernels.carries == Carried::Attributes || self.frame.is_coloured()
    }

    /// Returns a vertex's attributes, or zeros if nothing reads them.
    #[inline(always)]
    fn attributes(&self, vertex: u32) -> [f32; 4] {
        if self.reads_attributes() {
            self.frame.attributes(vertex)
        } else {
            [0.0; 4]
        }
    }

    /// Returns a corner, to be lit by the light that its polygon sees.
    fn corner(&self, polygon: u32, vertex: u32) -> Item {
        Item {
            uniforms: self.uniforms_of(polygon),
            normal: self.frame.normal(vertex),
            position: [0.0; 3],
            attributes: self.attributes(vertex),
        }
    }

    /// Lights each polygon once.
    fn light_polygons(&self, at: ShadingRate, memory: Vec<f32>) -> (Cow<'a, [f32]>, Per) {
        let frame = self.frame;
        let item = |index: usize| {
            let polygon = &frame.polygons()[index];
            let normal = match at {
                ShadingRate::PolygonMean => vec3(frame.mean(polygon).normal).unit().array(),
                _ => frame.polygon_normal(polygon),
            };
            Item {
                uniforms: self.uniforms_of(index as u32),
                normal,
                position: [0.0; 3],
                attributes: if frame.is_coloured() {
                    let [r, g, b] = frame.mean(polygon).colour;
                    [r, g, b, 1.0]
                } else {
                    [0.0; 4]
                },
            }
        };
        let values = self.lit(memory, frame.polygons().len(), &[], &item);
        (values.into(), Per::Polygon)
    }

    /// Lights the corners of each polygon by the light that this polygon sees.
    fn light_corners(&self, is_weighted: bool, memory: Vec<f32>) -> (Cow<'a, [f32]>, Per) {
        let (frame, count) = (self.frame, self.varyings.count);
        let (first, corners) = all_corners(frame);
        let item = |i: usize| self.corner(corners[i].0, corners[i].1);
        let mut values = self.lit(memory, corners.len(), &[], &item);
        for_each_chunk(
            &mut values[..],
            CHUNK * count,
            &|start, values: &mut [f32]| {
                let corners = &corners[start / count..];
                for (&(index, vertex), to) in corners.iter().zip(values.chunks_exact_mut(count)) {
                    if frame.clip_corner(vertex).is_some() {
                        to.copy_from_slice(&self.clipped(index, vertex));
                    }
                    if is_weighted {
                        let weight = frame.weight(vertex);
                        to.iter_mut().for_each(|value| *value *= weight);
                    }
                }
            },
        );
        (values.into(), Per::Corner(first))
    }

    /// Returns the varying of a vertex on `polygon`. A corner that clipping made is interpolated
    /// between the ends of its edge; any other vertex is lit.
    fn clipped(&self, polygon: u32, vertex: u32) -> Vec<f32> {
        let Some(corner) = self.frame.clip_corner(vertex) else {
            let item = |_| self.corner(polygon, vertex);
            return self.lit(Vec::new(), 1, &[], &item);
        };
        let ends = [corner.a, corner.b].map(|v| self.clipped(polygon, v));
        let mut to = vec![0.0; self.varyings.count];
        between(self.varyings.great_circles, &corner, &ends, &mut to);
        to
    }

    /// Lights `count` vertices on several threads. Kernels may only take whole blocks, so the last
    /// one is padded. The contents of `values` do not matter. If all vertices have the first
    /// material and no extras, `ready` may hold their normals in a row.
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
        // Chunks need a size even if there are no varyings.
        let size = CHUNK * stride.max(1);
        for_each_chunk(&mut values[..], size, &|first, mut rest: &mut [f32]| {
            let mut first = first / stride;
            if !ready.is_empty() {
                let whole = rest.len() / stride / BLOCK * BLOCK;
                let normals = &ready[first..first + whole];
                let (here, others) = rest.split_at_mut(whole * stride);
                // Directional lights do not read points.
                self.light(self.uniforms_of_material(0), [normals; 2], &[], here);
                (rest, first) = (others, first + whole);
            }
            let (mut normals, mut points) = ([[0.0; 3]; BATCH], [[0.0; 3]; BATCH]);
            let mut attributes = [[0.0; 4]; BATCH];
            let mut lit = vec![0.0; BATCH * own];
            while !rest.is_empty() {
                let most = BATCH.min(rest.len() / stride);
                // Vertices with the same uniforms are gathered until they change or the batch is
                // full.
                let mut next = item(first);
                let (uniforms, mut k) = (next.uniforms, 0);
                while next.uniforms == uniforms {
                    (normals[k], points[k]) = (next.normal, next.position);
                    attributes[k] = next.attributes;
                    k += 1;
                    if k == most {
                        break;
                    }
                    next = item(first + k);
                }
                // The padding holds vertices of earlier batches, or zeros. What they are lit to is
                // not copied.
                let padded = k.next_multiple_of(BLOCK);
                let to = &mut lit[..padded * own];
                let vectors = [&normals[..padded], &points[..padded]];
                self.light(uniforms, vectors, &attributes[..padded], to);
                let (here, others) = rest.split_at_mut(k * stride);
                // The engine's own varyings follow the method's.
                for (k, to) in here.chunks_exact_mut(stride).enumerate() {
                    to[..own].copy_from_slice(&lit[k * own..][..own]);
                    let [r, g, b, _] = attributes[k];
                    extras.write(&mut to[own..], points[k], [r, g, b]);
                }
                (rest, first) = (others, first + k);
            }
        });
        values
    }

    /// Lights vertices that share their uniforms.
    fn light(
        &self,
        uniforms: UniformsIndex,
        [normals, points]: [&[[f32; 3]]; 2],
        attributes: &[[f32; 4]],
        to: &mut [f32],
    ) {
        debug_assert_eq!(normals.len(), points.len(), "a position a normal");
        let vertices = Vertices {
            uniforms: &self.uniforms[uniforms.0 as usize],
            normals,
            points,
            attributes,
        };
        (self.light)(&vertices, to);
    }
}

/// Returns the uniforms of each polygon, which sees light and eye from its own place, and behind
/// them the uniforms of the materials.
fn by_polygon(frame: &Frame, materials: Vec<Uniforms>) -> Vec<Uniforms> {
    let polygons = frame.polygons();
    let Some(first) = materials.first() else {
        return materials;
    };
    // Every element is overwritten below.
    let mut all = vec![first.bare(); polygons.len()];
    for_each_chunk(&mut all[..], CHUNK, &|first, part: &mut [Uniforms]| {
        for (polygon, to) in polygons[first..].iter().zip(part) {
            let material = &materials[polygon.material as usize];
            *to = material.seen_from(frame.mean(polygon).position);
        }
    });
    all.extend(materials);
    all
}

/// Returns the index of each polygon's first corner in the list of all corners, and the polygon and
/// vertex of each corner.
fn all_corners(frame: &Frame) -> (Vec<u32>, Vec<(u32, u32)>) {
    let polygons = frame.polygons();
    let mut count = 0;
    let starts = polygons.iter().map(|polygon| {
        let start = count;
        count += polygon.count;
        start
    });
    let first: Vec<u32> = starts.collect();
    let mut corners = vec![(0, 0); count as usize];
    for_each_chunk(
        &mut corners[..],
        CHUNK,
        &|start, part: &mut [(u32, u32)]| {
            // The polygon of this part's first corner. Some of its corners may belong to the part
            // before.
            let begun = first.partition_point(|first| *first as usize <= start) - 1;
            let skipped = start - first[begun] as usize;
            let all = (begun..polygons.len()).flat_map(|index| {
                let vertices = frame.corners(&polygons[index]).iter();
                vertices.map(move |&vertex| (index as u32, vertex))
            });
            for (to, corner) in part.iter_mut().zip(all.skip(skipped)) {
                *to = corner;
            }
        },
    );
    (first, corners)
}

/// Stores the varying of a corner that clipping made: it lies between the varyings at the ends of
/// its edge, and is never lit again.
fn between(great_circle: bool, corner: &ClipCorner, ends: &[Vec<f32>; 2], to: &mut [f32]) {
    let [a, b] = ends;
    for ((to, a), b) in to.iter_mut().zip(a).zip(b) {
        [*to, _] = ramp(*a, *b, corner.t, 0.0);
    }
    if great_circle {
        let normals = [unit(a), unit(b)];
        let circle = GreatCircle::new(vec3(corner.face), normals, corner.t, 0.0);
        to[..3].copy_from_slice(&circle.normal().array());
    }
}

/// Computes the `values` of the corners that clipping made, `count` of them per vertex, and
/// multiplies all values by the weights of perspective if `is_weighted`.
pub(super) fn finish(
    frame: &Frame,
    values: &mut [f32],
    count: usize,
    great_circle: bool,
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
        for_each_chunk(values, CHUNK * count, &|first, values: &mut [f32]| {
            let vertices = &frame.vertices()[first / count..];
            for (varying, vertex) in values.chunks_exact_mut(count).zip(vertices) {
                let weight = frame.scaled_weight(vertex);
                varying.iter_mut().for_each(|value| *value *= weight);
            }
        });
    }
}

/// Returns the normal that `values` begin with.
pub(super) fn unit(values: &[f32]) -> Vec3<f32> {
    vec3([values[0], values[1], values[2]])
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::builtin::builtin;
    use crate::scene::{Light, Scene};
    use alloc::format;
    use glam::DVec3;

    /// Uses more polygons than a chunk holds, so that chunks begin and end inside polygons.
    #[test]
    fn polygons_and_corners_of_several_chunks_are_those_of_one_loop() {
        let mesh = builtin("sphere?rings=160&segments=160").expect("a built-in mesh");
        let mut scene = Scene::of_mesh(mesh);
        scene.lights = Vec::from([Light::positional(DVec3::new(2.0, 3.0, 4.0), [1.0; 3])]);
        let frame = scene.frame().expect("a scene in its range");
        let polygons = frame.polygons();
        assert!(polygons.len() > CHUNK, "{} polygons", polygons.len());
        let (first, corners) = all_corners(&frame);
        let mut expected = Vec::new();
        for (index, polygon) in (0..).zip(polygons) {
            assert_eq!(first[index as usize] as usize, expected.len());
            expected.extend(frame.corners(polygon).iter().map(|&vertex| (index, vertex)));
        }
        assert!(corners == expected && corners.len() % CHUNK != 0);

        let variant = Variant::parse("fast-phong").expect("a method");
        let lightings = frame.lightings().iter();
        let materials: Vec<Uniforms> = lightings.map(|l| variant.uniforms(l, 1.0)).collect();
        let all = by_polygon(&frame, materials.clone());
        assert_eq!(all.len(), polygons.len() + materials.len());
        for (polygon, found) in polygons.iter().zip(&all) {
            let material = &materials[polygon.material as usize];
            let expected = material.seen_from(frame.mean(polygon).position);
            assert_eq!(format!("{found:?}"), format!("{expected:?}"));
        }
    }

    /// An engine reads the frame's normals in place of varyings where both are equal, and nowhere
    /// else.
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
                let setup = SetUp::new(&variant, &frame, SimdLevel::Scalar, 1.0, Vec::new());
                let Varyings { values, count, .. } = &setup.varyings;
                let is_borrowed = matches!(values, Cow::Borrowed(_));
                assert_eq!(is_borrowed, is_there);
                let clipped = |v: u32| frame.clip_corner(v).is_some();
                let vertices = (0..).zip(frame.vertices()).filter(|(v, _)| !clipped(*v));
                for (index, vertex) in vertices {
                    let weight = match scene.interpolation {
                        Interpolation::Perspective => frame.scaled_weight(vertex),
                        Interpolation::Screen => 1.0,
                    };
                    let expected = frame.normal(index).map(|x| x * weight);
                    assert_eq!(values[index as usize * count..][..3], expected, "{index}");
                }
            }
        }
    }
}
