//! The varyings of vertices, which edges and spans interpolate. Most methods use one of the types
//! here.

use crate::number::{Num, Vec3};
use crate::shading::{LightAt, PerLight, Values};

/// What a vertex carries. A method with other varyings implements this itself and sets
/// `type Carries = Self`.
///
/// Vertex loops are compiled once per type, so methods with equal varyings share them. An engine
/// interpolates every value of [`Carries::Varying`] linearly, on the screen or in perspective.
pub trait Carries: 'static {
    /// What the varyings are computed from, so what engines must prepare.
    const FROM: Carried = Carried::Lit;
    /// The varyings: values, vectors and tuples of them.
    type Varying<F: Num>: Values<F>;
    /// The names of the values of [`Carries::Varying`], in order, for traces. A name that ends in
    /// `_i` stands for one value per light.
    const NAMES: &'static [&'static str] = &[];
    /// Returns the varyings of a vertex with the unit normal `n`. Methods that are lit once per
    /// polygon call it once per polygon.
    fn vertex<F: Num>(lit: &LightAt<'_, F>, n: Vec3<F>) -> Self::Varying<F>;
}

/// What varyings are computed from.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum Carried {
    /// Only the normal, which is carried unchanged: an engine may read the frame's normals and skip
    /// the vertex pass.
    Normal,
    /// The normal and the light.
    Lit,
    /// The normal and the light, both in the frame of eye and first light (`light/eye_frame.rs`),
    /// where z points to the eye.
    Turned,
    /// The normal, the light and the vertex's own values, [`LightAt::attributes`].
    Attributes,
}

/// The normal N.
#[derive(Clone, Copy, Debug)]
pub struct Normal;

impl Carries for Normal {
    const FROM: Carried = Carried::Normal;
    type Varying<F: Num> = Vec3<F>;
    const NAMES: &'static [&'static str] = &["Nx", "Ny", "Nz"];

    #[inline(always)]
    fn vertex<F: Num>(_: &LightAt<'_, F>, n: Vec3<F>) -> Vec3<F> {
        n
    }
}

/// The normal N in the frame of eye and first light.
#[derive(Clone, Copy, Debug)]
pub struct TurnedNormal;

impl Carries for TurnedNormal {
    const FROM: Carried = Carried::Turned;
    type Varying<F: Num> = Vec3<F>;
    const NAMES: &'static [&'static str] = &["Nx", "Ny", "Nz"];

    #[inline(always)]
    fn vertex<F: Num>(_: &LightAt<'_, F>, n: Vec3<F>) -> Vec3<F> {
        n
    }
}

/// The products J = L·N of up to `L` lights and K = V·N, then the normal N.
#[derive(Clone, Copy, Debug)]
pub struct ProductsAndNormal<const L: usize>;

impl<const L: usize> Carries for ProductsAndNormal<L> {
    type Varying<F: Num> = ((PerLight<F, L>, F), Vec3<F>);
    const NAMES: &'static [&'static str] = &["J_i", "K", "Nx", "Ny", "Nz"];

    #[inline(always)]
    fn vertex<F: Num>(lit: &LightAt<'_, F>, n: Vec3<F>) -> Self::Varying<F> {
        (lit.products(n), n)
    }
}

/// The normal N, the position P, and 1/w.
#[derive(Clone, Copy, Debug)]
pub struct NormalAndPlace;

impl Carries for NormalAndPlace {
    type Varying<F: Num> = (Vec3<F>, Vec3<F>, F);
    const NAMES: &'static [&'static str] = &["Nx", "Ny", "Nz", "Px", "Py", "Pz", "w"];

    #[inline(always)]
    fn vertex<F: Num>(lit: &LightAt<'_, F>, n: Vec3<F>) -> Self::Varying<F> {
        (n, lit.point(), n.x.broadcast(1.0))
    }
}

/// The colour by equation 2.1, clamped to 0..=1.
#[derive(Clone, Copy, Debug)]
pub struct Colour;

impl Carries for Colour {
    type Varying<F: Num> = Vec3<F>;
    const NAMES: &'static [&'static str] = &["Ir", "Ig", "Ib"];

    #[inline(always)]
    fn vertex<F: Num>(lit: &LightAt<'_, F>, n: Vec3<F>) -> Vec3<F> {
        lit.clamped(lit.shade(n)) // 2.1
    }
}
