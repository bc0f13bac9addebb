//! Runs and spans: what engines hand to kernels, and what a walk starts from.
//!
//! A *span* is all pixels of a polygon between two edges on a scanline; a *run* is a piece of it,
//! as the visible ones. The scanline engines start one in `ActiveEdges::add_run`
//! (`src/raster/spans/active.rs`), [`SpanShader`](crate::shading::SpanShader) by [`RunList::add`],
//! with the varyings at both ends of the span and the [`SpanPlace`] of the run. It stores two
//! values for each varying: the value at the first pixel and its growth ([`ramp`]), or for methods
//! that read their span the values at both ends ([`Needs::reads_span`]). Kernels wrap them in a
//! [`Span`], which [`Shader::walk`] receives: [`Span::linear`] interpolates, [`Span::ends`],
//! [`Span::parameter`] and [`Span::place`] tell where the run is on its span. Because the ends are
//! those of the whole span, what hides parts of it changes no colour.

use crate::number::{Num, Vec3};
use crate::shading::walks::Linear;
use crate::shading::walks::values::each;
use crate::shading::{Kinds, Method, Needs, Shader, UniformsIndex, Values, Varying};
use alloc::vec::Vec;

/// A run of pixels of one polygon on one scanline: a span, or a visible piece of one.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Run {
    /// The uniforms to shade it with.
    pub uniforms: UniformsIndex,
    /// The index of the polygon in [`Frame::polygons`](crate::frame::Frame::polygons).
    pub polygon: u32,
    /// The column of the first pixel.
    pub x: u32,
    /// How many pixels it has.
    pub pixels: u32,
    /// Where a [`PixelKernel`](super::PixelKernel) puts its colours: the index of the first.
    pub to: u32,
}

impl Run {
    /// Returns the colours of its pixels among the colours of all runs.
    #[inline(always)]
    pub fn of<'c>(&self, colours: &'c mut [[f32; 3]]) -> &'c mut [[f32; 3]] {
        &mut colours[self.to as usize..][..self.pixels as usize]
    }
}

/// The place of a run on its span, for methods that ask for it ([`Needs::spans`]).
#[derive(Clone, Copy, Debug)]
pub(crate) struct SpanPlace<T = f32> {
    /// The scanline.
    pub y: u32,
    /// The parameter at the centre of the run's first pixel: 0 at the left end of the whole span, 1
    /// at its right end.
    pub t0: T,
    /// How much the parameter grows per pixel: `1 / (x_2 − x_1)`.
    pub dt: T,
    /// The first column of the whole span inside the picture.
    pub start: u32,
    /// How many pixels the whole span has inside the picture.
    pub pixels: u32,
}

/// The values that runs start from, two for each varying and extra: the value at the first pixel
/// and its growth per pixel; or, for methods that read their span, the values at both ends.
#[derive(Clone, Debug, Default)]
pub(crate) struct Starts {
    /// The groups of all runs: their first values, and their second ones.
    groups: Vec<[[f32; GROUP]; 2]>,
    /// How many varyings and extras a run has.
    count: usize,
}

/// How many values a group holds: a normal or a colour, and a weight. Groups are stored without a
/// loop over their values.
pub(crate) const GROUP: usize = 4;

impl Starts {
    /// Adds a group. A run has as many as hold its values, one after the other; what fills up the
    /// last group means nothing.
    #[inline(always)]
    pub fn push(&mut self, first: [f32; GROUP], second: [f32; GROUP]) {
        self.groups.push([first, second]);
    }

    /// Adds all groups of a run. `of` returns the two values of a varying, by its index.
    #[inline(always)]
    pub fn add(&mut self, of: impl Fn(usize) -> [f32; 2]) {
        for from in (0..self.count).step_by(GROUP) {
            let mut group = [[0.0; GROUP]; 2];
            for i in from..self.count.min(from + GROUP) {
                [group[0][i - from], group[1][i - from]] = of(i);
            }
            self.groups.push(group);
        }
    }

    /// Returns the values of a run.
    #[inline(always)]
    pub fn of(&self, run: usize) -> RunValues<'_, f32> {
        let groups = self.count.div_ceil(GROUP);
        RunValues(&self.groups[run * groups..][..groups])
    }

    pub fn clear(&mut self) {
        self.groups.clear();
    }
}

/// The values that a run starts from, in groups.
#[derive(Clone, Copy, Debug)]
pub(crate) struct RunValues<'a, T>(pub &'a [[[T; GROUP]; 2]]);

impl<T: Copy> RunValues<'_, T> {
    /// Returns the two values of a varying: see [`Starts`].
    #[inline(always)]
    pub fn of(&self, varying: usize) -> [T; 2] {
        // The whole group is copied, so that loops over literal varyings step four values by one
        // addition.
        self.0[varying / GROUP].map(|values| values[varying % GROUP])
    }
}

/// Runs that are shaded, or walked along, by one call.
#[derive(Clone, Debug, Default)]
pub(crate) struct RunList {
    pub runs: Vec<Run>,
    pub starts: Starts,
    /// The place of each run, for methods that ask for it; otherwise empty.
    pub places: Vec<SpanPlace>,
}

impl RunList {
    /// Makes an empty list for runs with `count` varyings and extras.
    pub fn new(count: usize) -> Self {
        let mut list = RunList::default();
        list.prepare(count);
        list
    }

    /// Empties the list and prepares it for runs with `count` varyings and extras.
    pub fn prepare(&mut self, count: usize) {
        self.clear();
        self.starts.count = count;
    }

    /// Adds a run of a span whose varyings are `a` and `b` at its ends. Stores the run's place if
    /// the method asks for it.
    pub fn add(&mut self, needs: Needs, run: Run, [a, b]: [&[f32]; 2], place: SpanPlace) {
        let start = |i| needs.start([a[i], b[i]], place.t0, place.dt);
        self.starts.add(start);
        self.runs.push(run);
        if needs.reads_span() {
            self.places.push(place);
        }
    }

    pub fn clear(&mut self) {
        self.runs.clear();
        self.starts.clear();
        self.places.clear();
    }
}

/// Returns the value and the growth from which a linear interpolation starts: the value at `t0`
/// between `a` and `b`, and its growth over a step of `dt`.
///
/// ```text
/// ΔI = (I_2 − I_1) / (y_2 − y_1)  along edges,   ΔI = (I_2 − I_1) / (x_2 − x_1)  along scan lines      (L21 3.5, 4.1)
/// ```
#[inline(always)]
pub(crate) fn ramp<F: Num>(a: F, b: F, t0: F, dt: F) -> [F; 2] {
    let difference = b - a;
    [a + difference * t0, difference * dt] // 3.5, 4.1
}

/// What [`Shader::walk`] starts from: a run, or a block of pixels whose varyings are known.
///
/// Most methods call [`Span::linear`]. Methods that read their span ([`Needs::spans`]) call
/// [`Span::ends`] and [`Span::parameter`].
#[derive(Clone, Copy)]
pub struct Span<'a, S: Shader, F: Num> {
    start: Start<'a, S, F>,
    lights: usize,
    zero: F,
}

#[derive(Clone, Copy)]
enum Start<'a, S: Shader, F: Num> {
    Block(Varying<S, F>),
    Run(RunStart<'a, F::One>),
}

/// A run in the form from which kernels start walks.
#[derive(Clone, Copy)]
pub(crate) struct RunStart<'a, T> {
    /// The two values of each varying: see [`Starts`].
    pub values: RunValues<'a, T>,
    /// The column of the first pixel.
    pub x: u32,
    /// How many pixels the run has.
    pub pixels: u32,
    /// The run's place on its span, if the method asks for it.
    pub place: Option<SpanPlace<T>>,
    /// The values that [`Shader::polygon`] returned for the polygon.
    pub constants: &'a [T],
}

impl<'a, S: Shader, F: Num> Span<'a, S, F> {
    /// Makes the start of a block from the varyings at each of its pixels. Any value will do as
    /// `zero`.
    #[cfg_attr(not(feature = "simd"), expect(dead_code))]
    #[inline(always)]
    pub(crate) fn of_block(lights: usize, at: Varying<S, F>, zero: F) -> Self {
        Span {
            start: Start::Block(at),
            lights,
            zero: zero.broadcast(0.0),
        }
    }

    /// Makes the start of a run. Any value will do as `zero`.
    #[inline(always)]
    pub(crate) fn of_run(lights: usize, run: RunStart<'a, F::One>, zero: F) -> Self {
        Span {
            start: Start::Run(run),
            lights,
            zero: zero.broadcast(0.0),
        }
    }

    /// Starts linear interpolation of the varyings. A block starts with steps of 0: its only `next`
    /// returns the varyings.
    #[inline(always)]
    pub fn linear(self) -> Linear<Varying<S, F>> {
        let none = Varying::<S, F>::filled(self.lights, self.zero);
        match self.start {
            Start::Block(at) => Linear { at, step: none },
            Start::Run(run) => Linear {
                at: each(
                    none,
                    #[inline(always)]
                    |i, value| {
                        [*value, _] = run.block_ramp(i, *value);
                    },
                ),
                step: each(
                    none,
                    #[inline(always)]
                    |i, value| {
                        [_, *value] = run.block_ramp(i, *value);
                    },
                ),
            },
        }
    }

    /// Returns the varyings at both ends of the whole span, of which the run may be a piece. For
    /// methods that read their span.
    #[inline(always)]
    pub fn ends(&self) -> [Varying<S, F::One>; 2] {
        let (run, filled) = (
            self.run(),
            Varying::<S, F::One>::filled(self.lights, self.one()),
        );
        [
            each(
                filled,
                #[inline(always)]
                |i, value| [*value, _] = run.values.of(i),
            ),
            each(
                filled,
                #[inline(always)]
                |i, value| [_, *value] = run.values.of(i),
            ),
        ]
    }

    /// Returns the parameter at the centre of the first pixel, 0 at the left end of the whole span
    /// and 1 at its right end, and its growth per pixel. For methods that read their span.
    #[inline(always)]
    pub fn parameter(&self) -> [F::One; 2] {
        let place = self.place_of_run();
        [place.t0, place.dt]
    }

    /// Returns column and row of the centre of the first pixel, or of each pixel in the first
    /// block, in pixels. For methods that read their span.
    #[inline(always)]
    pub fn place(&self) -> [F; 2] {
        let (x, y) = (self.run().x, self.place_of_run().y);
        [
            self.zero
                .of_each(|k| self.zero.one((x + k as u32) as f32 + 0.5)),
            self.zero.broadcast(y as f32 + 0.5),
        ]
    }

    /// Returns how many pixels the run has.
    #[inline(always)]
    pub(crate) fn pixels(&self) -> u32 {
        self.run().pixels
    }

    /// Returns the constants that [`Shader::polygon`] computed for the polygon.
    #[inline(always)]
    pub fn constants(&self) -> S::Constants<F::One> {
        let run = self.run();
        each(
            S::Constants::<F::One>::filled(self.lights, self.one()),
            #[inline(always)]
            |i, value| *value = run.constants[i],
        )
    }

    #[inline(always)]
    fn one(&self) -> F::One {
        self.zero.one(0.0)
    }

    #[inline(always)]
    fn run(&self) -> &RunStart<'a, F::One> {
        match &self.start {
            Start::Run(run) => run,
            Start::Block(_) => unreachable!("a method that reads its span walks along runs"),
        }
    }

    #[inline(always)]
    fn place_of_run(&self) -> SpanPlace<F::One> {
        let place = self.run().place;
        place.expect("engines keep the places of runs for methods that read their span")
    }
}

impl<T: Num> RunStart<'_, T> {
    /// Returns the value of a varying at the first pixel and its growth per pixel.
    #[inline(always)]
    pub fn ramp(&self, varying: usize) -> [T; 2] {
        let values = self.values.of(varying);
        match self.place {
            None => values,
            Some(SpanPlace { t0, dt, .. }) => ramp(values[0], values[1], t0, dt),
        }
    }

    /// Returns a varying at each pixel of the first block, and its growth per block. Any value will
    /// do as `zero`.
    #[inline(always)]
    pub fn block_ramp<F: Num<One = T>>(&self, varying: usize, zero: F) -> [F; 2] {
        let [at, step] = self.ramp(varying);
        // One pixel at a time this spares a multiplication by 0 and one by 1, which change no
        // value.
        match F::WIDTH {
            1 => [zero.of_each(|_| at), zero.of_each(|_| step)],
            width => [
                zero.of_each(|k| at + step * k as f32),
                zero.of_each(|_| step) * width as f32,
            ],
        }
    }
}

/// A corner of a polygon, as [`Shader::polygon`] reads it.
#[derive(Clone, Copy, Debug)]
pub struct Corner<F> {
    /// The unit normal.
    pub normal: Vec3<F>,
    /// Column and row in the picture, in pixels.
    pub place: [F; 2],
    /// near/w, the weight of perspective; 1 without perspective.
    pub weight: F,
    /// The position in the world.
    pub position: Vec3<F>,
}

/// The corners of a polygon and their normals, as [`Shader::polygon`] reads them.
#[derive(Clone, Copy, Debug)]
pub struct Corners<'a, F> {
    /// The corners, in order.
    pub all: &'a [Corner<F>],
    /// The polygon's own unit normal.
    pub face: Vec3<F>,
    /// False for a piece that clipping has cut off: the normals of its corners then mean nothing,
    /// so decide from `whole`.
    pub is_whole: bool,
    /// The unit normals at the corners of the whole polygon. All normals of the piece lie between
    /// them.
    pub whole: &'a [Vec3<F>],
    /// The mean of the normals at all corners of the whole polygon, not normalised.
    pub mean: Vec3<F>,
}

/// The constants that a method has computed for each polygon, by the polygon's index.
#[derive(Clone, Debug, Default)]
pub(crate) struct PolygonConstants {
    /// The kind of each polygon; unused by methods of one kind.
    pub kinds: Vec<u8>,
    /// The constants of each polygon, one after the other: its [`Shader::Constants`].
    pub values: Vec<f32>,
}

impl PolygonConstants {
    /// Returns the kind of a polygon and the values of its constants.
    #[inline(always)]
    pub fn of<M: Method>(&self, lights: usize, polygon: u32) -> (u8, &[f32]) {
        let (polygon, count) = (polygon as usize, M::Kinds::constants(lights));
        let kind = if M::Kinds::NAMES.is_empty() {
            0
        } else {
            self.kinds[polygon]
        };
        let values = if count == 0 {
            &[][..]
        } else {
            &self.values[polygon * count..][..count]
        };
        (kind, values)
    }
}
