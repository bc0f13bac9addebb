//! What vertices carry: the varyings, which edges and spans interpolate. Most methods carry one of those here.

use crate::number::{Num, Vec3};
use crate::shading::{Lit, PerLight, Values};

/// What a vertex carries. A method with other varyings implements this itself, and sets `type Carries = Self`.
pub trait Carries: 'static {
    /// What it is made from: what engines get ready.
    const FROM: Carried = Carried::Lit;
    /// The varyings: values, vectors and tuples of them.
    type Varying<F: Num>: Values<F>;
    /// The names of its values, in order, for traces: a name that ends in `_i` stands for a value of each light.
    const NAMES: &'static [&'static str] = &[];
    /// Returns the varyings of a vertex with the unit normal `n`; once per polygon for methods that are lit there.
    fn vertex<F: Num>(lit: &Lit<'_, F>, n: Vec3<F>) -> Self::Varying<F>;
}

/// What varyings are made from.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Carried {
    /// The normal itself: an engine may borrow the frame's normals and skip the vertex pass.
    Normal,
    /// The normal and light.
    Lit,
    /// The normal and light, both in the frame of eye and first light (`light/eye_frame.rs`), in which z is toward the eye.
    Turned,
    /// [`Lit::attributes`], too.
    Attributes,
}

/// N.
#[derive(Clone, Copy, Debug)]
pub struct Normal;

impl Carries for Normal {
    const FROM: Carried = Carried::Normal;
    type Varying<F: Num> = Vec3<F>;
    const NAMES: &'static [&'static str] = &["Nx", "Ny", "Nz"];

    #[inline(always)]
    fn vertex<F: Num>(_: &Lit<'_, F>, n: Vec3<F>) -> Vec3<F> {
        n
    }
}

/// N in the frame of eye and first light.
#[doc(hidden)]
#[derive(Clone, Copy, Debug)]
pub struct TurnedNormal;

impl Carries for TurnedNormal {
    const FROM: Carried = Carried::Turned;
    type Varying<F: Num> = Vec3<F>;
    const NAMES: &'static [&'static str] = &["Nx", "Ny", "Nz"];

    #[inline(always)]
    fn vertex<F: Num>(_: &Lit<'_, F>, n: Vec3<F>) -> Vec3<F> {
        n
    }
}

/// J = L·N of up to `L` lights and K = V·N; N.
#[doc(hidden)]
#[derive(Clone, Copy, Debug)]
pub struct ProductsAndNormal<const L: usize>;

impl<const L: usize> Carries for ProductsAndNormal<L> {
    type Varying<F: Num> = ((PerLight<F, L>, F), Vec3<F>);
    const NAMES: &'static [&'static str] = &["J_i", "K", "Nx", "Ny", "Nz"];

    #[inline(always)]
    fn vertex<F: Num>(lit: &Lit<'_, F>, n: Vec3<F>) -> Self::Varying<F> {
        (lit.products(n), n)
    }
}

/// N, position, 1/w.
#[doc(hidden)]
#[derive(Clone, Copy, Debug)]
pub struct NormalAndPlace;

impl Carries for NormalAndPlace {
    type Varying<F: Num> = (Vec3<F>, Vec3<F>, F);
    const NAMES: &'static [&'static str] = &["Nx", "Ny", "Nz", "Px", "Py", "Pz", "w"];

    #[inline(always)]
    fn vertex<F: Num>(lit: &Lit<'_, F>, n: Vec3<F>) -> Self::Varying<F> {
        (n, lit.point(), n.x.broadcast(1.0))
    }
}

/// The colour of a vertex by equation 2.1, clamped.
#[derive(Clone, Copy, Debug)]
pub struct Colour;

impl Carries for Colour {
    type Varying<F: Num> = Vec3<F>;
    const NAMES: &'static [&'static str] = &["Ir", "Ig", "Ib"];

    #[inline(always)]
    fn vertex<F: Num>(lit: &Lit<'_, F>, n: Vec3<F>) -> Vec3<F> {
        lit.clamped(lit.shade(n)) // 2.1
    }
}
