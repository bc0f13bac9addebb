//! Walks that report each step: the values of every pixel of a run, for traces. Nothing here is in
//! a loop that draws.

use super::{Extra, ExtraWalk, Extras, Pixels, is_general};
use crate::shading::kernels::runs::RunStart;
use crate::shading::walks::Walk;
use crate::shading::walks::values::{Values, count, each};
use crate::shading::{Carries, CarriesOf, Kinds, LightAt, Method, Shader, Span, Visit};
use alloc::vec::Vec;

/// Calls a function with each run of a job, in order.
pub(crate) type WalkedKernel = fn(&Pixels<'_>, &mut dyn FnMut(WalkedRun));

/// The walks of a method, for traces. They are compiled once, for any number of lights.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Walked {
    /// The names of a varying's values: [`Carries::NAMES`].
    pub names: &'static [&'static str],
    /// The names of a pixel's values, [`Shader::VALUES`]; empty for methods of several kinds.
    pub values: &'static [&'static str],
    /// Walks along runs as the scalar pixel loop does, and reports the values; `None` for plain
    /// functions, which have no walks.
    pub walk: Option<WalkedKernel>,
}

impl Walked {
    /// Compiles the walks of a method.
    pub const fn of<M: Method>() -> Walked {
        Walked {
            names: <CarriesOf<M> as Carries>::NAMES,
            values: match M::Kinds::NAMES {
                [] => <<M::Kinds as Kinds>::First as Shader>::VALUES,
                _ => &[],
            },
            walk: Some(walked::<M>),
        }
    }

    /// Describes a method whose pixels are computed by a plain function.
    pub const fn none<M: Method>() -> Walked {
        Walked {
            values: &[],
            walk: None,
            ..Walked::of::<M>()
        }
    }
}

/// The values that a walk had along a run.
#[derive(Debug, Default)]
pub(crate) struct WalkedRun {
    /// The name of the polygon's kind, if the method has kinds.
    pub kind: Option<&'static str>,
    /// The names of a pixel's values: [`Shader::VALUES`].
    pub names: &'static [&'static str],
    /// For each pixel its values, then its position, colour and weight if the run has them
    /// ([`Extras`]).
    pub values: Vec<Vec<f32>>,
    /// The intermediate values of each pixel, by name: [`Walk::inside`].
    pub inside: Vec<(&'static str, Vec<Vec<f32>>)>,
}

/// Walks along runs as the scalar pixel loop does.
fn walked<M: Method>(job: &Pixels<'_>, to: &mut dyn FnMut(WalkedRun)) {
    for (uniforms, runs) in job.by_uniforms() {
        let stored = uniforms.stored();
        let own = count::<<CarriesOf<M> as Carries>::Varying<f32>>(stored.lights.len());
        let method = M::new(job.parameters, &stored.model);
        let lit = LightAt::new(stored, 0.0, is_general::<M>(job, uniforms));
        for (index, run) in runs {
            let (kind, start) = job.start::<M>(index, run);
            let walking = Walking {
                kind: M::Kinds::NAMES.get(usize::from(kind)).copied(),
                start,
                extra: job.extras.start(own, &start, 0.0),
                extras: job.extras,
                lit,
                to,
            };
            method.kinds().visit(kind, walking);
        }
    }
}

/// The loop over a run's pixels, for the polygon's kind.
struct Walking<'a, 'to> {
    kind: Option<&'static str>,
    start: RunStart<'a, f32>,
    extra: ExtraWalk<f32>,
    extras: Extras,
    lit: LightAt<'a, f32>,
    to: &'to mut dyn FnMut(WalkedRun),
}

impl<C: Carries> Visit<C> for Walking<'_, '_> {
    fn visit<S: Shader<Carries = C>>(mut self, kind: S) {
        let mut walk = kind.walk(&self.lit, Span::of_run(self.lit.count(), self.start, 0.0));
        let mut run = WalkedRun {
            kind: self.kind,
            names: S::VALUES,
            ..WalkedRun::default()
        };
        for pixel in 0..self.start.pixels as usize {
            walk.inside(&mut |name, value| run.see(pixel, name, value));
            run.values.push(Vec::new());
            read(walk.next(), &mut |value| run.values[pixel].push(value));
            run.add_extra(self.extras, self.extra.next());
        }
        (self.to)(run);
    }
}

/// Passes the values of a group to `to`, in order. It is compiled for each method, so it does
/// nothing else.
#[inline(never)]
fn read<V: Values<f32>>(group: V, to: &mut dyn FnMut(f32)) {
    each(group, |_, value: &mut f32| to(*value));
}

impl WalkedRun {
    /// Appends the extras that exist to the values of the last pixel.
    fn add_extra(&mut self, extras: Extras, extra: Extra<f32>) {
        let values = self.values.last_mut().expect("a pixel was added");
        if extras.point {
            values.extend(extra.point.array());
        }
        if extras.albedo {
            values.extend(extra.albedo.array());
        }
        if extras.weight {
            values.push(extra.weight);
        }
    }

    /// Adds an intermediate value of a pixel.
    fn see(&mut self, pixel: usize, name: &'static str, value: f32) {
        let known = self.inside.iter().position(|(known, _)| *known == name);
        let place = known.unwrap_or_else(|| {
            self.inside.push((name, Vec::new()));
            self.inside.len() - 1
        });
        let pixels = &mut self.inside[place].1;
        pixels.resize_with(pixel + 1, Vec::new);
        pixels[pixel].push(value);
    }
}
