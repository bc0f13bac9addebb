//! Methods as kernels compile them: of one way to shade, or of one for each kind of polygons.

use crate::number::{Num, Real};
use crate::shading::walks::values::{count, each};
use crate::shading::{Carries, Corners, Fit, Info, LightModel, Lit, Needs, On, Shader, Value};

/// A method as kernels compile it. Every [`Shader`] is one, of a single kind. A method that shades polygons of several kinds says how
/// it chooses: each kind is a [`Shader`] of its own, or another method's, and has its own loop, constants and walk. Such methods are
/// scalar only, as the G-buffer does not keep kinds.
pub trait Method: Copy + Default + 'static {
    /// The description of the method.
    const INFO: Info;
    /// What it needs of engines: for all of its kinds, whose own needs are not read.
    const NEEDS: Needs = Needs::PIXELS;
    /// The kinds: a tuple of up to five that carry the same.
    type Kinds: Kinds;

    /// Says whether it draws a frame, or spans of a material: see [`Shader::on`].
    fn on(_: On<'_>) -> Fit {
        Fit::Draws
    }
    /// Makes the method: see [`Shader::new`].
    #[inline(always)]
    fn new(_parameters: &[Value], _model: &LightModel) -> Self {
        Self::default()
    }
    /// Makes the kinds. Override this if they have parameters.
    #[inline(always)]
    fn kinds(self) -> Self::Kinds {
        Self::Kinds::default()
    }
    /// True if SIMD walks along runs with these parameters: see [`Shader::walks_along_runs`]. Methods of several kinds are not asked.
    #[inline(always)]
    fn walks_along_runs(self) -> bool {
        true
    }
    /// Chooses a polygon's kind, and sets up its constants: see [`Shader::polygon`].
    fn polygon<R: Real>(self, lit: &Lit<'_, R>, polygon: &Corners<'_, R>) -> Chosen<Self, R>;
}

/// The constants of a polygon's kind.
#[doc(hidden)]
pub type Chosen<M, R> = <<M as Method>::Kinds as Kinds>::Constants<R>;
/// What the vertices of a method carry.
#[doc(hidden)]
pub type CarriesOf<M> = <<M as Method>::Kinds as Kinds>::Carries;

impl<S: Shader> Method for S {
    const INFO: Info = S::INFO;
    const NEEDS: Needs = S::NEEDS;
    type Kinds = (S,);

    fn on(on: On<'_>) -> Fit {
        S::on(on)
    }
    #[inline(always)]
    fn new(parameters: &[Value], model: &LightModel) -> Self {
        S::new(parameters, model)
    }
    #[inline(always)]
    fn kinds(self) -> (S,) {
        (self,)
    }
    #[inline(always)]
    fn walks_along_runs(self) -> bool {
        S::walks_along_runs(self)
    }
    #[inline(always)]
    fn polygon<R: Real>(self, lit: &Lit<'_, R>, polygon: &Corners<'_, R>) -> Chosen<Self, R> {
        OneOf::First(S::polygon(self, lit, polygon))
    }
}

/// A generic closure over a kind.
#[doc(hidden)]
pub trait Visit<C: Carries> {
    /// Runs it for `kind`.
    fn visit<S: Shader<Carries = C>>(self, kind: S);
}

/// Kinds of polygons.
#[doc(hidden)]
pub trait Kinds: Copy + Default + 'static {
    /// Their names: those of the methods that they are, or the kinds' own. None if there is only one kind.
    const NAMES: &'static [&'static str];
    /// What vertices carry, for all of them.
    type Carries: Carries;
    /// The first of them; the only one, where there is SIMD.
    type First: Shader<Carries = Self::Carries>;
    /// The constants of a polygon of one of them.
    type Constants<F: Num>;

    /// Returns how many values the constants of a kind take at most.
    fn constants(lights: usize) -> usize;
    /// Passes the values of a polygon's constants to `to` in order, and returns its kind.
    fn put<F: Num>(constants: Self::Constants<F>, to: impl FnMut(usize, &mut F)) -> u8;
    /// Calls `to` with a kind: each has a loop of its own.
    fn visit(self, kind: u8, to: impl Visit<Self::Carries>);
}

/// A value for one of up to five kinds.
#[doc(hidden)]
#[derive(Clone, Copy, Debug)]
pub enum OneOf<A, B = (), C = (), D = (), E = ()> {
    First(A),
    Second(B),
    Third(C),
    Fourth(D),
    Fifth(E),
}

macro_rules! kinds {
    ($count:literal: $first:ident $(, $name:ident $place:tt)*; $($all:ident $variant:ident $index:literal),*) => {
        impl<$first: Shader $(, $name: Shader<Carries = $first::Carries>)*> Kinds for ($first, $($name,)*) {
            const NAMES: &'static [&'static str] = match $count {
                1 => &[],
                _ => &[$($all::INFO.name),*],
            };
            type Carries = $first::Carries;
            type First = $first;
            type Constants<F: Num> = OneOf<$($all::Constants<F>),*>;

            fn constants(lights: usize) -> usize {
                [$(count::<$all::Constants<f32>>(lights)),*].into_iter().fold(0, usize::max)
            }
            #[inline(always)]
            fn put<F: Num>(constants: Self::Constants<F>, to: impl FnMut(usize, &mut F)) -> u8 {
                match constants {
                    $(OneOf::$variant(one) => { each(one, to); $index })*
                    #[allow(unreachable_patterns)] // of five
                    _ => unreachable!("there are no more kinds"),
                }
            }
            #[inline(always)]
            fn visit(self, kind: u8, to: impl Visit<Self::Carries>) {
                match kind {
                    $($place => to.visit(self.$place),)*
                    _ => to.visit(self.0),
                }
            }
        }
    };
}

kinds!(1: A; A First 0);
kinds!(2: A, B 1; A First 0, B Second 1);
kinds!(3: A, B 1, C 2; A First 0, B Second 1, C Third 2);
kinds!(4: A, B 1, C 2, D 3; A First 0, B Second 1, C Third 2, D Fourth 3);
kinds!(5: A, B 1, C 2, D 3, E 4; A First 0, B Second 1, C Third 2, D Fourth 3, E Fifth 4);
