//! The properties that must hold in every world.

use super::passes;
use super::renderers::{depth_rounding, distinct, name, renderers};
use fastphong::frame::{DepthRange, Frame, FrameBuilder, FrameError};
use fastphong::mesh::Material;
use fastphong::picture::{LinearPicture, Picture, Picture8};
use fastphong::raster::trace::parts::TraceActive;
use fastphong::raster::{self, DrawOptions, Edges, NO_POLYGON, Renderer};
use fastphong::reference::{self, Model, Visibility};
use fastphong::scene::{Clipping, DepthBuffer, HiddenSurfaces, Lighting, Place, Scene};
use fastphong::shading::{METHODS, Variant};
use glam::DVec3;
use std::collections::BTreeSet;
use std::ops::AddAssign;
use std::sync::OnceLock;

/// Counts of what was checked. A run that checks little proves little.
#[derive(Clone, Copy, Debug, Default)]
pub struct Tally {
    /// Worlds that the program refuses with a message.
    pub refused: usize,
    /// Worlds in which a polygon is visible.
    pub seen: usize,
    /// Pictures by engines and instruction sets that were compared with the span engine's visible
    /// polygons.
    pub other_engines: usize,
    /// Polygons that the barycentric renderer drew as well.
    pub simple_polygons: usize,
    /// Pixels of methods that were compared with the reference under a bound of less than a grey
    /// level.
    pub pixels_in_bound: usize,
    /// Pictures that were drawn on one thread and on three.
    pub threads: usize,
    /// Second passes over the same depths that drew what the first one drew.
    pub second_passes: usize,
}

impl AddAssign for Tally {
    fn add_assign(&mut self, other: Tally) {
        self.refused += other.refused;
        self.seen += other.seen;
        self.other_engines += other.other_engines;
        self.simple_polygons += other.simple_polygons;
        self.pixels_in_bound += other.pixels_in_bound;
        self.threads += other.threads;
        self.second_passes += other.second_passes;
    }
}

/// Checks every property of a scene.
///
/// # Errors
/// One sentence about the first thing that does not hold.
pub fn check(scene: &Scene) -> Result<Tally, String> {
    let mut tally = Tally::default();
    let frame = match scene.frame() {
        Ok(frame) => frame,
        Err(FrameError::Polygon { index }) => return Err(format!("polygon {index} is invalid")),
        Err(_) => {
            tally.refused = 1;
            return Ok(tally);
        }
    };
    check_coverage(&frame)?;
    tally.simple_polygons = check_simple_polygons(&frame)?;
    let world = SeenLight::new(scene, &frame)?;
    let truly = &world.visibility.polygons;
    tally.seen = usize::from(truly.pixels().iter().any(|&p| p != NO_POLYGON));
    for renderer in renderers() {
        world.check_visibility(renderer)?;
    }
    tally.other_engines = renderers().len() - 1;
    for entry in METHODS {
        let variant = entry.variant();
        for renderer in distinct(&variant, &frame) {
            tally.pixels_in_bound += world.check_method(&variant, renderer)?;
            tally.threads += 1;
        }
    }
    tally.second_passes = passes::check(&frame)?;
    check_views(&frame)?;
    check_trace(&frame)?;
    Ok(tally)
}

/// Copies polygons of `frame`, those whose numbers `is_taken` holds for, such that the colour of a
/// sample tells which of them is seen.
fn numbered(
    frame: &Frame,
    hidden_surfaces: HiddenSurfaces,
    is_taken: impl Fn(u32) -> bool,
) -> Result<Frame, String> {
    let mut builder = FrameBuilder::new(frame.width() as u32, frame.height() as u32);
    builder
        .hidden_surfaces(hidden_surfaces)
        .depth_range(frame.depth_range())
        .clipping(frame.clipping());
    for (number, polygon) in (0u32..).zip(frame.polygons()) {
        if !is_taken(number) {
            continue;
        }
        let dark = Material {
            // Exact: fewer than 2²⁴ polygons.
            ambient: [(number + 1) as f32 / (1 << 24) as f32; 3],
            diffuse: [0.0; 3],
            specular: [0.0; 3],
            shininess: 1.0,
        };
        let material = builder.lighting(Lighting::new(&dark, [1.0; 3], &[], DVec3::Z));
        let corners: Vec<u32> = frame
            .corners(polygon)
            .iter()
            .map(|&corner| {
                let mut vertex = frame.vertex(corner);
                (vertex.material, vertex.normal) = (material, [0.0, 0.0, 1.0]);
                builder.vertex(vertex)
            })
            .collect();
        builder.polygon(&corners, [0.0, 0.0, 1.0], number);
    }
    builder
        .finish()
        .map_err(|error| format!("the scene's frame is none by the builder's rules: {error}"))
}

/// Returns the number of the polygon seen at each sample of a frame that [`numbered`] made.
///
/// The row engine has depth from plane equations, but from edges where it walks along runs, for
/// slerp Phong alone: `walks` says which.
fn numbers(numbered: &Frame, renderer: Renderer, walks: bool) -> Picture<u32> {
    let method = Variant::parse(if walks { "slerp-phong" } else { "flat" }).expect("a method");
    let picture = method
        .render_linear_with(numbered, renderer)
        .expect("a method for the frame");
    picture.map(|[red, _, _, alpha]| match alpha {
        0.0 => NO_POLYGON,
        _ => (red * (1 << 24) as f32) as u32 - 1,
    })
}

/// Returns a message about the first sample in which two pictures differ and for which `counts`
/// holds.
fn difference<T: Copy + PartialEq + std::fmt::Debug>(
    expected: &Picture<T>,
    actual: &Picture<T>,
    counts: impl Fn(usize, usize) -> bool,
) -> Option<String> {
    for y in 0..expected.height() {
        for x in 0..expected.width() {
            let (a, b) = (expected.get(x, y), actual.get(x, y));
            if a != b && counts(x, y) {
                return Some(format!("{a:?} and {b:?} at {x}, {y}"));
            }
        }
    }
    None
}

/// Every polygon covers the same samples in all engines and in the reference. In draw order, the
/// last polygon at a sample is visible.
fn check_coverage(frame: &Frame) -> Result<(), String> {
    if frame.clipping() == Clipping::NdcCube {
        // The depth of a sample decides if it is drawn, and depth is rounded.
        return Ok(());
    }
    let ordered = numbered(frame, HiddenSurfaces::DrawOrder, |_| true)?;
    let truth = reference::visibility(&ordered).polygons;
    let ours = raster::polygon_indices(&ordered);
    if let Some(where_) = difference(&truth, &ours, |_, _| true) {
        return Err(format!(
            "reference and span engine cover other pixels: polygon {where_}"
        ));
    }
    for renderer in renderers() {
        for walks in [false, true] {
            let ours = numbers(&ordered, renderer, walks);
            if let Some(where_) = difference(&truth, &ours, |_, _| true) {
                let name = name(renderer);
                return Err(format!(
                    "reference and {name} cover other pixels: polygon {where_}"
                ));
            }
        }
    }
    Ok(())
}

/// A trace has each edge from its first line to its last, edges come in pairs, and each pixel comes
/// once.
fn check_trace(frame: &Frame) -> Result<(), String> {
    let naive = Variant::parse("naive-phong").expect("a method");
    let trace = naive
        .trace(frame, None)
        .map_err(|error| error.to_string())?;
    let numbers = raster::polygon_indices(frame);
    for line in &trace.lines {
        let at = |what: &str| Err(format!("line {} of the trace: {what}", line.y));
        let y = line.y as i32;
        if line.left.iter().any(|edge| trace.edges[*edge].end != y) {
            return at("an edge leaves that does not end there");
        }
        let is_active = |edge: &TraceActive| {
            let edge = &trace.edges[edge.edge];
            edge.crosses && (edge.first..edge.end).contains(&y)
        };
        if !line.active.iter().all(is_active) {
            return at("an edge is active that does not cross it");
        }
        let polygon = |edge: &TraceActive| trace.edges[edge.edge].polygon;
        let mut polygons = line.active.chunk_by(|a, b| polygon(a) == polygon(b));
        if polygons.any(|edges| !edges.len().is_multiple_of(2)) {
            return at("a polygon has an odd number of edges");
        }
        let mut seen = vec![NO_POLYGON; frame.width()];
        for run in &line.runs {
            let pixels = run.x as usize..run.x as usize + run.pixels;
            if seen[pixels.clone()].iter().any(|&p| p != NO_POLYGON) {
                return at("a pixel is in two runs");
            }
            seen[pixels].fill(line.spans[run.span].polygon as u32);
        }
        if seen != numbers.row(line.y) {
            return at("other polygons are seen");
        }
    }
    Ok(())
}

/// Polygons that do not cross themselves cover the same samples after they are cut into triangles.
/// Returns how many there are.
fn check_simple_polygons(frame: &Frame) -> Result<usize, String> {
    if frame.clipping() == Clipping::NdcCube {
        return Ok(0);
    }
    let cut = fastphong::frame::triangulate::triangulated(frame);
    let simple: BTreeSet<u32> = cut.origins.iter().copied().collect();
    let is_simple = |number: u32| simple.contains(&number);
    for (number, polygon) in (0..).zip(frame.polygons()) {
        let places = frame.corners(polygon).iter().map(|&corner| {
            let vertex = &frame.vertices()[corner as usize];
            [vertex.x, vertex.y].map(|c| i64::from(c.to_bits()))
        });
        if !is_simple(number) && is_surely_simple(&places.collect::<Vec<_>>()) {
            return Err(format!(
                "polygon {number} is simple, and was not cut into triangles"
            ));
        }
    }
    let ordered = numbered(frame, HiddenSurfaces::DrawOrder, is_simple)?;
    let sources: Vec<u32> = ordered.polygons().iter().map(|p| p.source).collect();
    let cut = fastphong::frame::triangulate::triangulated(&ordered);
    let triangles = raster::barycentric_polygon_indices(&cut.frame, Edges::TopLeft);
    let from = |number: u32| match number {
        NO_POLYGON => NO_POLYGON,
        triangle => sources[cut.origins[triangle as usize] as usize],
    };
    let whole = raster::polygon_indices(&ordered).map(|number| match number {
        NO_POLYGON => NO_POLYGON,
        polygon => sources[polygon as usize],
    });
    match difference(&whole, &triangles.map(from), |_, _| true) {
        Some(where_) => Err(format!(
            "span engine and barycentric renderer cover other pixels: polygon {where_}"
        )),
        None => Ok(simple.len()),
    }
}

/// True if no two edges of a polygon have a common point, except for the corner between neighbours.
fn is_surely_simple(places: &[[i64; 2]]) -> bool {
    let side = |[ax, ay]: [i64; 2], [bx, by]: [i64; 2], [x, y]: [i64; 2]| {
        ((bx - ax) * (y - ay) - (by - ay) * (x - ax)).signum()
    };
    let touch = |[a, b]: [[i64; 2]; 2], [p, q]: [[i64; 2]; 2]| {
        let overlap =
            |c: usize| a[c].min(b[c]) <= p[c].max(q[c]) && p[c].min(q[c]) <= a[c].max(b[c]);
        side(a, b, p) * side(a, b, q) <= 0
            && side(p, q, a) * side(p, q, b) <= 0
            && overlap(0)
            && overlap(1)
    };
    let n = places.len();
    let edge = |i: usize| [places[i % n], places[(i + 1) % n]];
    (0..n).all(|i| {
        let [a, b] = edge(i);
        let [_, c] = edge(i + 1);
        // Neighbours share one corner. Their three corners must differ, and the path must not go
        // straight back.
        let goes_on = a != b
            && b != c
            && c != a
            && (side(a, b, c) != 0 || {
                let back = (a[0] - b[0]) * (c[0] - b[0]) + (a[1] - b[1]) * (c[1] - b[1]);
                back < 0
            });
        let others = (i + 2..n).filter(|j| (j + 1) % n != i);
        goes_on && others.into_iter().all(|j| !touch(edge(i), edge(j)))
    })
}

/// A frame, and the polygons that are visible in it.
struct SeenLight<'a> {
    scene: &'a Scene,
    frame: &'a Frame,
    numbered: Frame,
    visibility: Visibility,
    /// The samples whose visible polygon rounding cannot change.
    decided: Picture<bool>,
    truths: [OnceLock<LinearPicture>; Model::ALL.len()],
}

impl<'a> SeenLight<'a> {
    fn new(scene: &'a Scene, frame: &'a Frame) -> Result<SeenLight<'a>, String> {
        // The polygons are in the painter's order already.
        let hidden_surfaces = match frame.hidden_surfaces() {
            HiddenSurfaces::Painter(_) => HiddenSurfaces::DrawOrder,
            other => other,
        };
        let visibility = reference::visibility(frame);
        let margin = depth_margin(frame);
        Ok(SeenLight {
            scene,
            frame,
            numbered: numbered(frame, hidden_surfaces, |_| true)?,
            decided: visibility.depth_gap.map(|gap| gap > margin),
            visibility,
            truths: Default::default(),
        })
    }

    /// Checks that `renderer` shows the reference's polygon at each sample, unless another polygon
    /// is equally near up to rounding.
    fn check_visibility(&self, renderer: Renderer) -> Result<(), String> {
        let is_cube = self.frame.clipping() == Clipping::NdcCube;
        let counts = |x, y| !is_cube && self.decided.get(x, y);
        for walks in [false, true] {
            let seen = numbers(&self.numbered, renderer, walks);
            if let Some(where_) = difference(&self.visibility.polygons, &seen, counts) {
                let name = name(renderer);
                return Err(format!("reference and {name} see other polygons: {where_}"));
            }
        }
        Ok(())
    }

    fn truth(&self, model: Model) -> &LinearPicture {
        let number = Model::ALL.iter().position(|m| *m == model);
        self.truths[number.expect("a model of the reference")]
            .get_or_init(|| reference::shade(self.frame, &self.visibility, model).to_linear())
    }

    /// Checks a method's picture by `renderer` on one thread and on three. Returns how many pixels
    /// kept a bound of less than a grey level.
    fn check_method(&self, variant: &Variant, renderer: Renderer) -> Result<usize, String> {
        let frame = self.frame;
        let who = || format!("{} by {}", variant.info().name, name(renderer));
        let draw = || {
            let mut stored = Picture8::new(frame.picture_width(), frame.picture_height(), [7; 4]);
            let options = DrawOptions::by(renderer);
            let drawn = variant.draw(frame, &mut stored, options);
            drawn.expect("a picture of the frame's size");
            (
                stored,
                variant
                    .render_linear_with(frame, renderer)
                    .expect("a method for the frame"),
            )
        };
        let [one, three] = [0, 1].map(|pool| pools()[pool].install(draw));
        let bits = |picture: &LinearPicture| picture.map(|pixel| pixel.map(f32::to_bits));
        if let Some(where_) = difference(&one.0, &three.0, |_, _| true)
            .or_else(|| difference(&bits(&one.1), &bits(&three.1), |_, _| true))
        {
            return Err(format!("{}: threads change {where_}", who()));
        }
        let ours = one.1;
        if let Some(pixel) = ours.pixels().iter().find(|p| !is_colour(**p)) {
            return Err(format!("{}: a pixel is {pixel:?}", who()));
        }
        let bounds: Vec<f64> = variant.polygon_bounds(frame).collect();
        if let Some(bound) = bounds.iter().find(|bound| !(0.0..=1.0).contains(*bound)) {
            return Err(format!("{}: a bound is {bound}", who()));
        }
        let bounds = self.pixel_bounds(variant, renderer, &bounds);
        let model = variant.info().model;
        let truth = self.truth(model);
        let (mut jumps, mut count) = (None, 0);
        for y in 0..truth.height() {
            for x in 0..truth.width() {
                let (ours, truth) = (ours.get(x, y), truth.get(x, y));
                if ours[3] != truth[3] && frame.clipping() != Clipping::NdcCube {
                    return Err(format!("{}: another alpha at {x}, {y}", who()));
                }
                let Some(bound) = bounds.get(x, y) else {
                    continue;
                };
                let apart = (0..3).map(|c| f64::from(ours[c]) - f64::from(truth[c]));
                let most = apart.fold(0.0, |most, apart| f64::max(most, apart.abs()));
                if most > bound {
                    let changes = jumps.get_or_insert_with(|| self.changes(model));
                    if !is_jump(changes, (x, y), bound) {
                        let who = who();
                        return Err(format!(
                            "{who}: {most:.3e} over its bound {bound:.3e} at {x}, {y}"
                        ));
                    }
                }
                count += usize::from(bound < 1.0 / 255.0 && ours[3] > 0.0);
            }
        }
        Ok(count)
    }

    /// Returns the changes of the reference's pixels if the lights turn by a small angle, and by an
    /// angle 16 times as large: see [`is_jump`].
    fn changes(&self, model: Model) -> [Picture<f64>; 2] {
        [ANGLE, 16.0 * ANGLE].map(|angle| self.change(model, angle))
    }

    /// Returns the largest change of each pixel of the reference when the lights turn by an angle
    /// around an axis of the world.
    fn change(&self, model: Model, angle: f64) -> Picture<f64> {
        let truth = self.truth(model);
        let mut changes = truth.map(|_| 0.0);
        for turn in [DVec3::X, DVec3::Y, DVec3::Z].map(|axis| angle * axis) {
            for turn in [turn, -turn] {
                let mut scene = self.scene.clone();
                for light in &mut scene.lights {
                    light.place = match light.place {
                        Place::Infinite(toward) => Place::Infinite((toward + turn).normalize()),
                        Place::Local(position) => {
                            let far = (position - scene.camera.target).length();
                            Place::Local(position + far * turn)
                        }
                    };
                }
                let Ok(frame) = scene.frame() else { continue };
                let turned = reference::shade(&frame, &self.visibility, model).to_linear();
                let pixels = truth.pixels().iter().zip(turned.pixels());
                for (change, (a, b)) in changes.pixels_mut().iter_mut().zip(pixels) {
                    let apart = (0..3).map(|c| f64::from((a[c] - b[c]).abs()));
                    *change = apart.fold(*change, f64::max);
                }
            }
        }
        changes
    }

    /// Returns the bound at each pixel, from the bounds of polygons. A pixel has a bound only if
    /// `renderer` shows the reference's polygon at all its samples.
    fn pixel_bounds(
        &self,
        variant: &Variant,
        renderer: Renderer,
        bounds: &[f64],
    ) -> Picture<Option<f64>> {
        let frame = self.frame;
        let seen = variant.polygon_indices(frame, renderer);
        let n = frame.samples();
        let mut all = Picture::new(frame.picture_width(), frame.picture_height(), Some(0.0));
        for y in 0..frame.height() {
            for x in 0..frame.width() {
                let (ours, truly) = (seen.get(x, y), self.visibility.polygons.get(x, y));
                let bound = bounds.get(truly as usize).copied().unwrap_or(0.0);
                let all = &mut all.row_mut(y / n)[x / n];
                *all = all
                    .filter(|_| ours == truly)
                    .map(|most| f64::max(most, bound));
            }
        }
        all
    }
}

/// An angle above all errors of a cosine.
const ANGLE: f64 = 1e-4;

/// True if the reference jumps by more than `bound` at a pixel. Light from behind has no highlight,
/// so where L·N is 0 up to rounding, the last bit decides and no bound holds.
///
/// At a jump, a light that turns by [`ANGLE`] changes the picture as much as one that turns 16
/// times as far. Where the picture is smooth, the second one changes it about 16 times as much.
fn is_jump([near, far]: &[Picture<f64>; 2], (x, y): (usize, usize), bound: f64) -> bool {
    let (near, far) = (near.get(x, y), far.get(x, y));
    near > bound && far < 4.0 * near
}

/// True if all channels are in 0..=1.
fn is_colour(pixel: [f32; 4]) -> bool {
    pixel.iter().all(|channel| (0.0..=1.0).contains(channel))
}

/// Returns two thread pools, of one thread and of three.
fn pools() -> &'static [rayon::ThreadPool; 2] {
    static POOLS: OnceLock<[rayon::ThreadPool; 2]> = OnceLock::new();
    POOLS.get_or_init(|| {
        [1, 3].map(|threads| {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build();
            pool.expect("a pool of threads")
        })
    })
}

/// Returns the largest difference of two stored depths that may still be in the wrong order: twice
/// the error of one depth.
///
/// [`depth_rounding`] derives the rounding of two depths in 0..=1; it is proportional to the
/// largest depth of a corner. Under perspective −1/w is rounded, and z is `f/(f − n) (1 − n/w)`,
/// which is itself rounded if it is stored as levels. An orthographic depth that is computed at
/// each sample comes from a distance of up to f, divided by f − n. In a narrow buffer each depth
/// may be stored one level away.
fn depth_margin(frame: &Frame) -> f64 {
    let HiddenSurfaces::ZBuffer(DepthBuffer { bits, .. }) = frame.hidden_surfaces() else {
        return 0.0;
    };
    let range = frame.depth_range();
    let level = bits.most().map_or(0.0, |most| 2.0 / f64::from(most));
    let corners = frame.polygons().iter().flat_map(|p| frame.corners(p));
    let depths = || corners.clone().map(|&v| frame.vertices()[v as usize].depth);
    let largest_z = depths()
        .map(|depth| range.z(depth).abs())
        .fold(1.0, f64::max);
    let (near, far) = range.ends();
    let largest = match range {
        DepthRange::Orthographic { .. } => (2.0 + (far / (far - near)).abs()) * largest_z,
        // The factor from −1/w to z.
        DepthRange::Perspective { .. } => {
            let slope = near * (far / (far - near));
            let of_depth = slope * depths().map(f64::abs).fold(0.0, f64::max);
            of_depth + if level > 0.0 { largest_z } else { 0.0 }
        }
    };
    depth_rounding(frame) * largest + level
}

/// Draws every picture other than shaded colours, and the picture of the automatic method. None may
/// panic.
fn check_views(frame: &Frame) -> Result<(), String> {
    let views = [
        raster::normals(frame),
        raster::vertex_colours(frame, None),
        raster::vertex_colours(frame, Some(Edges::Closed)),
        raster::checkerboard(frame, None, 0.5, [[0.0; 3], [1.0; 3]]),
    ];
    for (number, view) in views.iter().enumerate() {
        if let Some(pixel) = view.pixels().iter().find(|p| !is_colour(**p)) {
            return Err(format!("view {number}: a pixel is {pixel:?}"));
        }
    }
    raster::depth(frame);
    for renderer in renderers() {
        Variant::auto(frame, renderer);
    }
    Ok(())
}
