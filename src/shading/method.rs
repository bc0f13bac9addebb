//! Methods as kernels compile them: with one loop for all polygons, or one loop for each kind of
//! polygon.

use crate::number::{Num, Real};
use crate::shading::walks::values::{count, each};
use crate::shading::{Carries, Corners, Fit, Info, LightAt, LightModel, Needs, On, Shader, Value};

/// A method as kernels compile it.
///
/// Every [`Shader`] is one: it shades all polygons in the same way. Implement this trait directly
/// for a method that chooses among several ways, polygon by polygon. Each way is a *kind*: a
/// [`Shader`] of your own or another method's, with its own loop, constants and walk.
/// [`Method::polygon`] chooses. These methods run as scalar code only, as the G-buffer does not
/// store kinds. `series/cubic_phong.rs` is a short one.
pub trait Method: Copy + Default + 'static {
    /// The description of the method: see [`Shader::INFO`].
    const INFO: Info;
    /// What the method needs from engines, for all of its kinds: their own needs are not read.
    const NEEDS: Needs = Needs::PIXELS;
    /// The kinds: a tuple of up to five types with the same [`Shader::Carries`].
    type Kinds: Kinds;

    /// Decides if the method draws a frame, or spans of a material: see [`Shader::on`].
    fn on(_: On<'_>) -> Fit {
        Fit::Draws
    }
    /// Makes the method from its parameters: see [`Shader::new`].
    #[inline(always)]
    fn new(_parameters: &[Value], _model: &LightModel) -> Self {
        Self::default()
    }
    /// Makes the kinds. Override this if they have parameters.
    #[inline(always)]
    fn kinds(self) -> Self::Kinds {
        Self::Kinds::default()
    }
    /// True if SIMD must walk along runs with these parameters: see [`Shader::walks_along_runs`].
    /// Not called for methods of several kinds.
    #[inline(always)]
    fn walks_along_runs(self) -> bool {
        true
    }
    /// Chooses a polygon's kind and returns the constants for it, as `OneOf::First(constants)` and
    /// so on: see [`Shader::polygon`].
    fn polygon<R: Real>(self, lit: &LightAt<'_, R>, polygon: &Corners<'_, R>) -> Chosen<Self, R>;
}

/// The constants of a polygon, for the kind that was chosen.
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
    fn polygon<R: Real>(self, lit: &LightAt<'_, R>, polygon: &Corners<'_, R>) -> Chosen<Self, R> {
        OneOf::First(S::polygon(self, lit, polygon))
    }
}

/// A generic closure: a function that works for every kind.
#[doc(hidden)]
pub trait Visit<C: Carries> {
    /// Calls the closure with `kind`.
    fn visit<S: Shader<Carries = C>>(self, kind: S);
}

/// The kinds of polygons that a method tells apart: a tuple of shaders.
#[doc(hidden)]
pub trait Kinds: Copy + Default + 'static {
    /// The names of the kinds: their methods' names, or their own. Empty if there is only one kind.
    const NAMES: &'static [&'static str];
    /// What vertices carry, for all kinds.
    type Carries: Carries;
    /// The first kind. SIMD compiles only methods of a single kind, which is this one.
    type First: Shader<Carries = Self::Carries>;
    /// The constants of a polygon of any of these kinds.
    type Constants<F: Num>;

    /// Returns how many values the constants take: the largest count of all kinds.
    fn constants(lights: usize) -> usize;
    /// Passes the constants of a polygon to `to`, value by value in order, and returns the
    /// polygon's kind.
    fn put<F: Num>(constants: Self::Constants<F>, to: impl FnMut(usize, &mut F)) -> u8;
    /// Calls `to` with the shader of a kind. Each call compiles another loop.
    fn visit(self, kind: u8, to: impl Visit<Self::Carries>);
}

/// The constants of a polygon, for the one of up to five kinds that [`Method::polygon`] chose.
#[derive(Clone, Copy, Debug)]
pub enum OneOf<A, B = (), C = (), D = (), E = ()> {
    /// For the first kind.
    First(A),
    /// For the second kind.
    Second(B),
    /// For the third kind.
    Third(C),
    /// For the fourth kind.
    Fourth(D),
    /// For the fifth kind.
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
                    #[allow(unreachable_patterns)] // five kinds need no last arm
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
