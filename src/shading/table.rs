//! The method table: add a line here for a new file beside this one.

use super::count::{OperationCounts, count};
use super::duff_phong::{DuffPhong, DuffPhongNear};
use super::fast_phong::FastPhong;
use super::flat::Flat;
use super::flat_average::FLAT_AVERAGE;
use super::gouraud::Gouraud;
use super::gouraud_separate::GouraudSeparate;
use super::naive_phong::NaivePhong;
use super::phong_rsqrt::PhongRsqrt;
use super::slerp_phong::SlerpPhong;
use super::slerp_phong_vector::SlerpPhongVector;
use super::span_bench::SpanBench;
use super::{Extras, Info, Kernels, Local, Perspective, Shader, Variant};

/// All shading methods.
pub static METHODS: &[Entry] = &[
    Entry::of::<Flat>(),
    Entry {
        info: &FLAT_AVERAGE,
        ..Entry::of::<Flat>()
    },
    Entry::of::<Gouraud>(),
    Entry::of::<GouraudSeparate>(),
    Entry::of::<NaivePhong>(),
    Entry::by_lights::<FastPhong<1>, FastPhong<4>, FastPhong<8>, FastPhong<64>>(),
    Entry::by_lights::<
        DuffPhong<1, true>,
        DuffPhong<4, true>,
        DuffPhong<8, true>,
        DuffPhong<64, true>,
    >(),
    Entry::of::<PhongRsqrt>(),
    Entry::by_lights::<DuffPhong<1>, DuffPhong<4>, DuffPhong<8>, DuffPhong<64>>()
        .near::<DuffPhongNear<4>, DuffPhongNear<64>>(),
    Entry::by_lights::<SlerpPhong<1>, SlerpPhong<4>, SlerpPhong<8>, SlerpPhong<64>>(),
    Entry::of::<SlerpPhongVector>(),
];

/// Kernels for 1 light, up to 4, up to 8 and up to 64.
type ByLights = [&'static Kernels; 4];

/// A row of the method table: the description of a method, and its kernels.
#[derive(Clone, Copy, Debug)]
pub struct Entry {
    /// The description of the method.
    pub info: &'static Info,
    directional: ByLights,
    near: ByLights,
    /// The functions that count operations: without a light or the eye at a position, and with one.
    pub(super) count: [fn(&SpanBench, &Variant) -> OperationCounts; 2],
}

impl Entry {
    /// Makes the row of a method, also of one defined outside this crate.
    pub const fn of<M: Shader>() -> Entry {
        Entry::by_lights::<M, M, M, M>()
    }

    /// Makes the row of a method whose varyings hold a number per light: compiled for 1, 4, 8 and 64 of them.
    pub const fn by_lights<A: Shader, B: Shader, C: Shader, D: Shader>() -> Entry {
        let all: ByLights = const {
            [
                &Kernels::of::<A>(),
                &Kernels::of::<B>(),
                &Kernels::of::<C>(),
                &Kernels::of::<D>(),
            ]
        };
        Entry {
            info: &A::INFO,
            directional: all,
            near: all,
            // For up to eight lights as many are stepped, for up to 64 as many as there are: what is counted.
            count: [count::<D>; 2],
        }
    }

    /// Takes other kernels where a light or the eye is at a position: for 4 lights and for 64.
    pub const fn near<A: Shader, B: Shader>(self) -> Entry {
        let [few, many] = const { [&Kernels::of::<A>(), &Kernels::of::<B>()] };
        Entry {
            near: [few, few, many, many],
            count: [self.count[0], count::<B>],
            ..self
        }
    }

    /// Returns the row called `name`.
    pub fn named(name: &str) -> Option<&'static Entry> {
        METHODS.iter().find(|entry| entry.info.name == name)
    }

    /// True if the barycentric renderer has it: it needs a pixel without its neighbours.
    pub fn is_barycentric(&self) -> bool {
        self.directional[0].linear
    }

    /// Returns the varyings that kernels add to those of the method, under perspective or not, with a light or the eye at a
    /// position (`near`) or not.
    pub(crate) fn extras(&self, near: bool, perspective: bool) -> Extras {
        let point = near && self.info.local == Local::PerPixel && self.near[0].linear;
        let divides = self.info.perspective == Perspective::Divides;
        Extras {
            point,
            weight: perspective && (divides || point),
        }
    }

    /// Returns the kernels for so many lights, some at positions (`near`) or none.
    pub(crate) fn kernels(&self, lights: usize, near: bool) -> &'static Kernels {
        let all = if near { self.near } else { self.directional };
        match lights {
            0 | 1 => all[0],
            2..=4 => all[1],
            5..=8 => all[2],
            _ => all[3],
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::number::Level;
    use std::collections::BTreeSet;

    /// Returns the functions in the tables of these methods, each once: AVX-512 takes those of AVX2 but for its shading.
    fn compiled(entries: &[Entry]) -> usize {
        let mut kernels = BTreeSet::new();
        for entry in entries {
            kernels.extend(entry.count.map(|count| count as usize));
            for table in [entry.directional, entry.near].as_flattened() {
                kernels.extend([table.vertices as usize, table.pixels as usize]);
                for simd in Level::ALL.into_iter().filter_map(table.simd) {
                    kernels.insert(simd.shade as usize);
                    kernels.extend(simd.vertices.map(|vertices| vertices as usize));
                    kernels.extend(simd.walk.map(|walk| walk as usize));
                }
            }
        }
        kernels.len()
    }

    /// Every kernel is compiled code, and all of it is compiled before anything is drawn: a method may cost no more than this.
    #[test]
    fn kernels_are_few() {
        let all = compiled(METHODS);
        std::println!("{all} kernels");
        assert!(all <= 150, "{all} kernels");
        for entry in METHODS {
            let own = compiled(&[*entry]);
            let by_lights = !core::ptr::eq(entry.directional[0], entry.directional[3]);
            let most = if by_lights { 24 } else { 8 };
            let near = !core::ptr::eq(entry.directional[0], entry.near[0]);
            assert!(
                own <= most * (1 + usize::from(near)),
                "{}: {own}",
                entry.info.name
            );
        }
    }
}
