//! The recorder of traces. It goes down the lines as the span engine does, and reads edges, spans
//! and runs between the engine's steps.

use super::document::{
    Trace, TraceActive, TraceCircle, TraceEdge, TraceEntry, TraceKind, TraceLight, TraceLine,
    TraceMaterial, TraceNames, TracePolygon, TraceRun, TraceSpan, TraceVertex,
};
use crate::frame::{Frame, SubPixel};
use crate::number::{Num, Vec3, vec3};
use crate::raster::depth::SampleDepth;
use crate::raster::setup::{Per, SetUp};
use crate::raster::spans::active::{ActiveEdges, EdgeState, PolygonSpan, parameter};
use crate::raster::spans::edge::first_centre;
use crate::raster::spans::edge_table::{EdgeTable, TableEdge};
use crate::raster::spans::line::VisibleLine;
use crate::scene::LightTerm;
use crate::shading::{LightUniforms, RunList, Variant, Walked, WalkedRun};
use alloc::collections::{BTreeMap, BTreeSet};
use alloc::format;
use alloc::string::{String, ToString};
use alloc::vec;
use alloc::vec::Vec;
use core::ops::Range;

/// Traces a method on its frame. Records all lines, or `only` one with the polygons that it meets.
pub(super) fn record(
    variant: &Variant,
    setup: &SetUp<'_>,
    walked: &Walked,
    only: Option<usize>,
) -> Trace {
    let frame = setup.frame;
    let part = Part::new(frame, only);
    let table = EdgeTable::new(frame);
    let bucket = |row| {
        let edges = table.bucket(row).iter();
        edges.filter_map(|edge| part.edge(edge.polygon, edge.corner))
    };
    let mut recorder = Recorder {
        setup,
        walked,
        part: &part,
        depth: SampleDepth::new(frame),
        list: RunList::new(setup.varyings.count),
        line: VisibleLine::new(frame.width(), SampleDepth::new(frame)),
        active: ActiveEdges::new(frame, &setup.varyings),
        before: BTreeSet::new(),
    };
    let mut lines = Vec::new();
    for row in 0..frame.height() {
        let is_recorded = only.is_none_or(|only| only == row);
        let line = recorder.next_line(row, table.bucket(row), is_recorded);
        lines.extend(line);
    }
    Trace {
        schema: "fastphong.trace/1",
        size: [frame.width(), frame.height()],
        samples: frame.samples(),
        unit: SubPixel::ONE.to_bits(),
        method: variant.to_string(),
        materials: (0..frame.lightings().len())
            .map(|material| material_of(setup, material))
            .collect(),
        names: TraceNames {
            varyings: recorder.named(walked.names),
            pixel: recorder.named(walked.values),
        },
        vertices: part.vertices.iter().map(|v| vertex(setup, *v)).collect(),
        polygons: part.polygons(setup),
        edges: part.edges(frame),
        buckets: (0..frame.height())
            .map(|row| bucket(row).collect())
            .collect(),
        lines,
    }
}

/// The part of a frame that a document holds. It has its own indices.
struct Part {
    /// The polygons by their index in the frame: the index in the document, and the index of the
    /// first edge.
    polygons: BTreeMap<u32, [usize; 2]>,
    /// The vertices, by their index in the frame.
    vertices: Vec<u32>,
}

impl Part {
    /// Selects all of a frame, or the polygons with an edge that crosses `only` one line or ends
    /// before its centre.
    fn new(frame: &Frame, only: Option<usize>) -> Part {
        let mut part = Part {
            polygons: BTreeMap::new(),
            vertices: Vec::new(),
        };
        let (mut edges, mut vertices) = (0, BTreeSet::new());
        for (index, polygon) in (0..).zip(frame.polygons()) {
            let corners = frame.corners(polygon);
            let rows = corners
                .iter()
                .map(|v| first_centre(frame.vertices()[*v as usize].y));
            let (first, end) = rows.fold((i32::MAX, i32::MIN), |(a, b), y| (a.min(y), b.max(y)));
            if only.is_none_or(|row| (first..=end).contains(&(row as i32))) {
                part.polygons.insert(index, [part.polygons.len(), edges]);
                edges += corners.len();
                vertices.extend(corners);
            }
        }
        part.vertices = vertices.into_iter().collect();
        part
    }

    /// Returns the index of an edge, if its polygon is in this part.
    fn edge(&self, polygon: u32, corner: u32) -> Option<usize> {
        let [_, first] = self.polygons.get(&polygon)?;
        Some(first + corner as usize)
    }

    fn vertex(&self, index: u32) -> usize {
        self.vertices.partition_point(|v| *v < index)
    }

    fn polygons(&self, setup: &SetUp<'_>) -> Vec<TracePolygon> {
        let polygon = |index: &u32| {
            let polygon = &setup.frame.polygons()[*index as usize];
            let corners = setup.frame.corners(polygon).iter();
            TracePolygon {
                corners: corners.map(|v| self.vertex(*v)).collect(),
                source: polygon.source,
                material: polygon.material,
                varyings: setup
                    .varyings
                    .of_polygon(*index)
                    .map_or_else(Vec::new, <[f32]>::to_vec),
            }
        };
        self.polygons.keys().map(polygon).collect()
    }

    fn edges(&self, frame: &Frame) -> Vec<TraceEdge> {
        let rows = 0..frame.height() as i32;
        let edges = self.polygons.keys().enumerate().flat_map(|(i, index)| {
            let corners = frame.corners(&frame.polygons()[*index as usize]);
            (0..corners.len()).map(move |corner| (i, corners, corner))
        });
        let edge = |(polygon, corners, corner): (usize, &[u32], usize)| {
            let y = |v: u32| frame.vertices()[v as usize].y;
            let (mut top, mut bottom) = (corners[corner], corners[(corner + 1) % corners.len()]);
            if y(top) > y(bottom) {
                (top, bottom) = (bottom, top);
            }
            let (first, end) = (first_centre(y(top)), first_centre(y(bottom)));
            TraceEdge {
                polygon,
                corner,
                top: self.vertex(top),
                bottom: self.vertex(bottom),
                first,
                end,
                crosses: first.max(rows.start) < end.min(rows.end),
            }
        };
        edges.map(edge).collect()
    }
}

fn vertex(setup: &SetUp<'_>, index: u32) -> TraceVertex {
    let vertex = &setup.frame.vertices()[index as usize];
    TraceVertex {
        at: [vertex.x, vertex.y].map(SubPixel::to_bits),
        depth: vertex.depth,
        normal: setup.frame.normal(index),
        varyings: match setup.varyings.per {
            Per::Vertex => setup.varyings.of_corner(0, 0, index).to_vec(),
            Per::Corner(_) | Per::Polygon => Vec::new(),
        },
    }
}

fn material_of(setup: &SetUp<'_>, material: usize) -> TraceMaterial {
    let lighting = &setup.frame.lightings()[material];
    let uniforms = &setup.uniforms[setup.uniforms_of_material(material as u32).0 as usize];
    let lights = lighting.lights.iter().zip(uniforms.stored().lights);
    let light = |(term, prepared): (&LightTerm, &LightUniforms)| {
        let is_far = !term.place.is_local() && !lighting.view.is_local();
        TraceLight {
            place: term.place.into(),
            diffuse: term.diffuse,
            specular: term.specular,
            l_v: is_far.then_some(prepared.l_v),
        }
    };
    TraceMaterial {
        ambient: lighting.ambient,
        lights: lights.map(light).collect(),
        eye: lighting.view.into(),
        n: lighting.shininess,
    }
}

/// The parts of the engine on their way down the lines.
struct Recorder<'a> {
    setup: &'a SetUp<'a>,
    walked: &'a Walked,
    part: &'a Part,
    depth: SampleDepth,
    list: RunList,
    line: VisibleLine,
    active: ActiveEdges<'a>,
    /// The edges that were active on the line before, by polygon and corner.
    before: BTreeSet<(u32, u32)>,
}

impl Recorder<'_> {
    /// Goes to the next line, as `scan` in `spans/mod.rs` does. Returns its record if
    /// `is_recorded`.
    fn next_line(
        &mut self,
        row: usize,
        bucket: &[TableEdge],
        is_recorded: bool,
    ) -> Option<TraceLine> {
        let width = self.setup.frame.width() as u32;
        self.active.next(bucket.iter(), row as i32);
        self.line.clear();
        let mut spans = Vec::new();
        self.active.spans(width, |_, span| spans.push(span));
        let states: Vec<EdgeState> = self.active.states().collect();
        let now = states.iter().map(|edge| (edge.polygon, edge.corner));
        let before = core::mem::replace(&mut self.before, now.collect());
        if !is_recorded {
            return None;
        }
        let known = |(polygon, corner): &(u32, u32)| self.part.edge(*polygon, *corner);
        let mut line = TraceLine {
            y: row,
            left: before.difference(&self.before).filter_map(known).collect(),
            stepped: before
                .intersection(&self.before)
                .filter_map(known)
                .collect(),
            entered: bucket.iter().map(|edge| self.entry(edge, row)).collect(),
            active: states.iter().map(|state| self.state(state)).collect(),
            ..TraceLine::default()
        };
        for span in &spans {
            let traced = self.draw(span, &states);
            line.spans.push(traced);
        }
        line.runs = self.runs(row);
        Some(line)
    }

    /// Returns the index of an edge of the recorded line.
    fn edge(&self, polygon: u32, corner: u32) -> usize {
        let edge = self.part.edge(polygon, corner);
        edge.expect("the polygons that a line meets are a part")
    }

    fn entry(&self, edge: &TableEdge, row: usize) -> TraceEntry {
        let vertices = self.setup.frame.vertices();
        let ends = [edge.top, edge.bottom].map(|v| &vertices[v as usize]);
        let [t0, dt] = parameter(ends, row as i32);
        let [from, to] = match self.setup.varyings.per {
            Per::Polygon => [&[][..]; 2],
            _ => self.active.ends(self.setup.varyings.count, edge),
        };
        TraceEntry {
            edge: self.edge(edge.polygon, edge.corner),
            t0,
            dt,
            from: from.to_vec(),
            to: to.to_vec(),
        }
    }

    fn state(&self, state: &EdgeState) -> TraceActive {
        let pair = |(a, b)| [a, b];
        TraceActive {
            edge: self.edge(state.polygon, state.corner),
            pixel: state.crossing.pixel(),
            rest: state.crossing.rest(),
            step: state.crossing.step(),
            depth: state.depth,
            at: state.at.clone(),
            by: state.by.clone(),
            circle: state.circle.map(|circle| TraceCircle {
                from: circle.from.array(),
                to: circle.to.array(),
                t: pair(circle.sines.t),
                rest: pair(circle.sines.rest),
                step: pair(circle.sines.step),
            }),
        }
    }

    /// Draws a span into the line, as the engine does, and records where it was seen.
    fn draw(&mut self, span: &PolygonSpan, states: &[EdgeState]) -> TraceSpan {
        let index = self.line.spans().len() as u32;
        self.line.add(*span);
        let line = self.line.drawn();
        let pixels = span.pixels();
        let mut seen: Vec<[usize; 2]> = Vec::new();
        for x in pixels.clone() {
            match seen.last_mut() {
                _ if line.span_at(x) != index => {}
                Some(last) if last[1] == x => last[1] += 1,
                _ => seen.push([x, x + 1]),
            }
        }
        let mut q = span.depth;
        let depth = |_| {
            let here = self.depth.stored(q);
            q += span.depth_step; // as `VisibleLine` steps it
            here
        };
        let [left, right] = [0, 1].map(|i| {
            let state = &states[span.left as usize + i];
            self.edge(state.polygon, state.corner)
        });
        TraceSpan {
            polygon: self.part.polygons[&span.polygon][0],
            left,
            right,
            start: span.start,
            end: span.end,
            t0: span.t0,
            dt: span.dt,
            depth: [span.depth, span.depth_step],
            depths: pixels.map(depth).collect(),
            seen,
        }
    }

    /// Returns the visible runs of a line.
    fn runs(&mut self, row: usize) -> Vec<TraceRun> {
        let mut found = Vec::new();
        self.line.runs(|span, pixels| found.push((*span, pixels)));
        let runs = found.into_iter();
        runs.map(|(span, pixels)| self.run(&span, pixels, row))
            .collect()
    }

    /// Shades one run by itself, and walks along it once more to record its values.
    fn run(&mut self, span: &PolygonSpan, pixels: Range<usize>, row: usize) -> TraceRun {
        let setup = self.setup;
        self.list.clear();
        let uniforms = setup.uniforms_of(span.polygon);
        self.active
            .add_run(span, row, pixels.clone(), uniforms, &mut self.list);
        self.list.runs[0].to = 0;
        let job = setup.pixels(&self.list);
        let mut colours = vec![[0.0; 3]; pixels.len()];
        (setup.kernels.pixels)(&job, &mut colours);
        let mut walked = WalkedRun::default();
        if let Some(walk) = self.walked.walk {
            walk(&job, &mut |run| walked = run);
        }
        let values = self.list.starts.of(0);
        let all = |k: usize| (0..setup.varyings.count).map(|i| values.of(i)[k]).collect();
        let inside = self.inside(&walked);
        TraceRun {
            span: self.line.drawn().span_at(pixels.start) as usize,
            x: pixels.start as u32,
            pixels: pixels.len(),
            t0: span.t0 + (pixels.start as u32 - span.start) as f32 * span.dt, // as `add_run` does
            dt: span.dt,
            at: all(0),
            by: all(1),
            is_ends: setup.varyings.keeps_ends,
            kind: walked.kind.map(|name| TraceKind {
                name,
                values: self.named(walked.names),
            }),
            values: walked.values,
            inside,
            colours: colours
                .into_iter()
                .map(|colour| colour.map(|c| c.clamp(0.0, 1.0)))
                .collect(),
        }
    }

    /// Returns the intermediate results of pixels. Where their values are N, adds N·N and its root,
    /// as methods with a true root compute them.
    fn inside(&self, walked: &WalkedRun) -> BTreeMap<&'static str, Vec<Vec<f32>>> {
        let mut inside: BTreeMap<_, _> = walked.inside.iter().cloned().collect();
        if walked.names == ["Nx", "Ny", "Nz"] {
            let normals = walked.values.iter();
            let squares: Vec<f32> = normals
                .map(|n| {
                    let n: Vec3<f32> = vec3([n[0], n[1], n[2]]);
                    n.dot(n)
                })
                .collect();
            let roots = squares.iter().map(|square| vec![Num::sqrt(*square)]);
            inside.insert("d", roots.collect());
            inside.insert("D", squares.into_iter().map(|d| vec![d]).collect());
        }
        inside
    }

    /// Writes out names for the frame's lights, and appends the names of the extras.
    fn named(&self, names: &[&str]) -> Vec<String> {
        let lights = self.setup.frame.light_count();
        let mut all = Vec::new();
        for name in names {
            match name.strip_suffix("_i") {
                Some(each) if lights == 1 => all.push(each.to_string()),
                Some(each) => all.extend((1..=lights).map(|i| format!("{each}_{i}"))),
                None if name.contains("_i") && lights > 1 => {
                    all.extend((1..=lights).map(|i| name.replace("_i", &format!("_{i}"))));
                }
                None => all.push(name.replace("_i", "")),
            }
        }
        if self.setup.extras.point {
            all.extend(["Px", "Py", "Pz"].map(String::from));
        }
        if self.setup.extras.albedo {
            all.extend(["Cr", "Cg", "Cb"].map(String::from));
        }
        if self.setup.extras.weight {
            all.push("w".into());
        }
        all
    }
}
