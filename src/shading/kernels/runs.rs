//! Runs and spans: what engines hand to kernels, and what a walk starts from.

use crate::number::{Num, Vec3};
use crate::shading::walks::Linear;
use crate::shading::walks::values::each;
use crate::shading::{Kinds, Method, Needs, Shader, UniformsIndex, Values, Varying};
use alloc::vec::Vec;

/// A run of pixels of one polygon on one scanline: a span, or a piece of one that is seen.
#[doc(hidden)]
#[derive(Clone, Copy, Debug)]
pub struct Run {
    /// The uniforms that it is shaded with.
    pub uniforms: UniformsIndex,
    /// The polygon, an index into [`Frame::polygons`](crate::frame::Frame::polygons).
    pub polygon: u32,
    /// The column of its first pixel.
    pub x: u32,
    /// The count of its pixels.
    pub pixels: u32,
}

/// The place of a run on its span: for methods that ask for it ([`Needs::spans`].
#[derive(Clone, Copy, Debug)]
pub struct SpanPlace<T = f32> {
    /// The scanline.
    pub y: u32,
    /// The parameter at the centre of the run's first pixel: 0 at the left end of its span, 1 at the right one, whatever is seen of
    /// it.
    pub t0: T,
    /// The growth of the parameter from pixel to pixel, `1 / (x_2 − x_1)`.
    pub dt: T,
    /// The first column of the whole span inside the picture.
    pub start: u32,
    /// The count of the whole span's pixels inside the picture.
    pub pixels: u32,
}

/// The values that runs start from, two for each varying and extra: the values at the first pixel and their growth from pixel
/// to pixel, or for methods that read their span the values at both of its ends.
#[derive(Clone, Debug, Default)]
pub(crate) struct Starts {
    values: Vec<f32>,
    /// How many varyings and extras a run has.
    count: usize,
}

impl Starts {
    /// Adds a run of as many values as the list was made for.
    #[inline(always)]
    pub fn push<const N: usize>(&mut self, first: [f32; N], second: [f32; N]) {
        debug_assert_eq!(self.count, N, "each run has all values that it starts from");
        self.values
            .extend_from_slice([first, second].as_flattened());
    }

    /// Adds a run of zeros, and returns its values: the first ones of all varyings, then the second ones.
    #[inline(always)]
    pub fn add(&mut self) -> [&mut [f32]; 2] {
        let from = self.values.len();
        self.values.resize(from + 2 * self.count, 0.0);
        let (first, second) = self.values[from..].split_at_mut(self.count);
        [first, second]
    }

    /// Returns the values of a run.
    #[inline(always)]
    pub fn of(&self, run: usize) -> [&[f32]; 2] {
        let values = &self.values[2 * run * self.count..][..2 * self.count];
        let (first, second) = values.split_at(self.count);
        [first, second]
    }

    pub fn clear(&mut self) {
        self.values.clear();
    }
}

/// Runs that are shaded, or walked along, by one call.
#[derive(Clone, Debug, Default)]
pub(crate) struct RunList {
    pub runs: Vec<Run>,
    pub starts: Starts,
    /// The places of the runs, for methods that ask for them.
    pub places: Vec<SpanPlace>,
}

impl RunList {
    /// Makes an empty list for runs of `count` varyings and extras.
    pub fn new(count: usize) -> Self {
        let mut list = RunList::default();
        list.prepare(count);
        list
    }

    /// Empties the list, for runs of `count` varyings and extras.
    pub fn prepare(&mut self, count: usize) {
        self.clear();
        self.starts.count = count;
    }

    /// Adds a run of a span: what its walk starts from, given the varyings at both ends, and its place if the method asks for it.
    pub fn add(&mut self, needs: Needs, run: Run, [a, b]: [&[f32]; 2], place: SpanPlace) {
        let [first, second] = self.starts.add();
        for i in 0..first.len() {
            [first[i], second[i]] = needs.start([a[i], b[i]], place.t0, place.dt);
        }
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

/// Starts a linearly interpolated value: what it is at `t0` between `a` and `b`, and its growth in a step of `dt`.
///
/// ```text
/// ΔI = (I_2 − I_1) / (y_2 − y_1)  along edges,   ΔI = (I_2 − I_1) / (x_2 − x_1)  along scan lines      (L21 3.5, 4.1)
/// ```
#[inline(always)]
pub(crate) fn ramp<F: Num>(a: F, b: F, t0: F, dt: F) -> [F; 2] {
    let difference = b - a;
    [a + difference * t0, difference * dt] // 3.5, 4.1
}

/// What a walk starts from: a run, or a block of pixels whose varyings are known.
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

/// A run, as kernels start it.
#[derive(Clone, Copy)]
pub(crate) struct RunStart<'a, T> {
    /// The two values of each varying: see [`Starts`].
    pub values: [&'a [T]; 2],
    /// The column of the first pixel.
    pub x: u32,
    /// The count of its pixels.
    pub pixels: u32,
    /// Its place, if the method asks for it.
    pub place: Option<SpanPlace<T>>,
    /// The values that [`Shader::polygon`] returned for the polygon.
    pub constants: &'a [T],
}

impl<'a, S: Shader, F: Num> Span<'a, S, F> {
    /// Starts a block from the varyings at each of its pixels. `zero` may be any value.
    #[cfg_attr(not(feature = "simd"), expect(dead_code))]
    #[inline(always)]
    pub(crate) fn of_block(lights: usize, at: Varying<S, F>, zero: F) -> Self {
        Span {
            start: Start::Block(at),
            lights,
            zero: zero.broadcast(0.0),
        }
    }

    /// Starts a run. `zero` may be any value.
    #[inline(always)]
    pub(crate) fn of_run(lights: usize, run: RunStart<'a, F::One>, zero: F) -> Self {
        Span {
            start: Start::Run(run),
            lights,
            zero: zero.broadcast(0.0),
        }
    }

    /// Starts a walk that interpolates linearly. A block starts with steps of 0, so that its one `next` returns the varyings.
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

    /// Returns the varyings at both ends of the span, of which the run may be a piece: for methods that read their span.
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
                |i, value| *value = run.values[0][i],
            ),
            each(
                filled,
                #[inline(always)]
                |i, value| *value = run.values[1][i],
            ),
        ]
    }

    /// Returns the parameter at the first pixel and its growth from pixel to pixel: see [`SpanPlace`].
    #[inline(always)]
    pub fn parameter(&self) -> [F::One; 2] {
        let place = self.place_of_run();
        [place.t0, place.dt]
    }

    /// Returns the column and the row of the centre of the first pixel, or of each pixel of the first block, in pixels.
    #[inline(always)]
    pub fn place(&self) -> [F; 2] {
        let (x, y) = (self.run().x, self.place_of_run().y);
        [
            self.zero
                .of_each(|k| self.zero.one((x + k as u32) as f32 + 0.5)),
            self.zero.broadcast(y as f32 + 0.5),
        ]
    }

    /// Returns the count of the run's pixels.
    #[inline(always)]
    pub(crate) fn pixels(&self) -> u32 {
        self.run().pixels
    }

    /// Returns what [`Shader::polygon`] made of the polygon.
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
    /// Returns the value of a varying at the first pixel and its growth from pixel to pixel.
    #[inline(always)]
    pub fn ramp(&self, varying: usize) -> [T; 2] {
        let values = [self.values[0][varying], self.values[1][varying]];
        match self.place {
            None => values,
            Some(SpanPlace { t0, dt, .. }) => ramp(values[0], values[1], t0, dt),
        }
    }

    /// Returns a varying at each pixel of the first block, and its growth from block to block. `zero` may be any value.
    #[inline(always)]
    pub fn block_ramp<F: Num<One = T>>(&self, varying: usize, zero: F) -> [F; 2] {
        let [at, step] = self.ramp(varying);
        match F::WIDTH {
            1 => [zero.of_each(|_| at), zero.of_each(|_| step)],
            width => [
                zero.of_each(|k| at + step * k as f32),
                zero.of_each(|_| step) * width as f32,
            ],
        }
    }
}

/// A corner of a polygon, as a method sets it up.
#[derive(Clone, Copy, Debug)]
pub struct Corner<F> {
    /// The unit normal.
    pub normal: Vec3<F>,
    /// Column and row on the picture, in pixels.
    pub place: [F; 2],
    /// near/w, the weight of perspective; 1 without.
    pub weight: F,
    /// The position in the world.
    pub position: Vec3<F>,
}

/// A polygon, as a method sets it up: see [`Shader::polygon`].
#[derive(Clone, Copy, Debug)]
pub struct Corners<'a, F> {
    /// Its corners, in order.
    pub all: &'a [Corner<F>],
    /// Its own unit normal.
    pub face: Vec3<F>,
    /// False for a piece that clipping made: the normals of its corners then mean nothing.
    pub is_whole: bool,
    /// Unit normals of corners of the whole polygon: all normals of the piece lie between these.
    pub whole: &'a [Vec3<F>],
    /// The mean of the normals of all corners of the whole polygon, not normalised.
    pub mean: Vec3<F>,
}

/// The constants that a method set up for each polygon, by its index.
#[derive(Clone, Debug, Default)]
pub(crate) struct PolygonConstants {
    /// The kinds.
    pub kinds: Vec<u8>,
    /// The values of each [`Shader::Constants`].
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
