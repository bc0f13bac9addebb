//! Compares SIMD blocks with plain `f32`, pixel by pixel, on every instruction set of this machine.

use super::*;
use crate::number::lanes::{Int, Lanes};
use crate::number::test_random::Random;
use std::vec;
use std::vec::Vec;

/// Calls a function with the token of each instruction set of this machine.
macro_rules! on_each_level {
    ($function:ident) => {
        #[cfg(target_arch = "x86_64")]
        {
            if crate::number::SimdLevel::Avx2.is_available() {
                $function::<fearless_simd::Avx2>();
            }
            if crate::number::SimdLevel::Avx512.is_available() {
                $function::<fearless_simd::Avx512>();
            }
        }
        #[cfg(target_arch = "aarch64")]
        $function::<fearless_simd::Neon>();
    };
}
pub(crate) use on_each_level;

/// Applies an operation to columns of values, block by block.
fn blocks<S: Token, F: Block<S>>(
    columns: [&[f32]; 3],
    operation: impl Fn(F, F, F) -> F,
) -> Vec<f32> {
    let simd = S::get();
    let mut out = vec![0.0; columns[0].len()];
    for x in (0..out.len()).step_by(F::WIDTH) {
        let load = |column: &[f32]| {
            let column = &column[x..x + F::WIDTH];
            F::load(simd, [column, &column[F::WIDTH - BLOCK..]], 0)
        };
        operation(load(columns[0]), load(columns[1]), load(columns[2]))
            .store_slice(&mut out[x..][..F::WIDTH]);
    }
    out
}

/// Returns every pair of special and random values, in whole blocks.
fn pairs() -> [Vec<f32>; 3] {
    let mut values = vec![
        0.0,
        -0.0,
        1.0,
        -1.0,
        0.5,
        255.0,
        1e-40,
        f32::MIN_POSITIVE,
        -3e38,
    ];
    values.extend([f32::MAX, f32::INFINITY, f32::NEG_INFINITY, f32::NAN]);
    let mut random = Random::new(3);
    values.extend((0..11).map(|_| random.signed()));
    assert_eq!(values.len() % 8, 0);
    let (mut a, mut b, mut c) = (Vec::new(), Vec::new(), Vec::new());
    for &x in &values {
        for &y in &values {
            a.push(x);
            b.push(y);
            c.push(random.signed());
        }
    }
    [a, b, c]
}

fn same(found: f32, expected: f32) -> bool {
    found == expected || (found.is_nan() && expected.is_nan())
}

/// Compares an operation on blocks with the operation on plain floats.
macro_rules! compare {
    ($s:ident, $f:ident, |$a:ident, $b:ident, $c:ident| $operation:expr) => {
        compare!($s, $f, |$a, $b, $c| $operation, |_: [f32; 3], _: f32| false)
    };
    ($s:ident, $f:ident, |$a:ident, $b:ident, $c:ident| $operation:expr, $also:expr) => {{
        #[allow(unused_variables)] // not every operation has three operands
        let (wide, one) = (
            |$a: $f, $b: $f, $c: $f| $operation,
            |$a: f32, $b: f32, $c: f32| $operation,
        );
        let pairs = pairs();
        let columns = pairs.each_ref().map(|column| &column[..]);
        for (i, found) in blocks::<$s, $f>(columns, wide).into_iter().enumerate() {
            let operands = columns.map(|column| column[i]);
            let [a, b, c] = operands;
            let expected = one(a, b, c);
            assert!(
                same(found, expected) || $also(operands, found),
                "{} of {operands:?}: {found}, expected {expected}",
                stringify!($operation)
            );
        }
    }};
}

fn operations_of<S: Token, F: Block<S>>() {
    compare!(S, F, |a, b, c| a + b);
    compare!(S, F, |a, b, c| a - b);
    compare!(S, F, |a, b, c| a * b);
    compare!(S, F, |a, b, c| a / b);
    compare!(S, F, |a, b, c| -a);
    compare!(S, F, |a, b, c| Num::sqrt(a));
    compare!(S, F, |a, b, c| a + 0.5);
    compare!(S, F, |a, b, c| a - 0.5);
    compare!(S, F, |a, b, c| a * 0.3);
    compare!(S, F, |a, b, c| a.broadcast(3.0));
    compare!(S, F, |a, b, c| Num::max(a, 0.0));
    compare!(S, F, |a, b, c| Num::max(a, -0.75));
    compare!(S, F, |a, b, c| Num::gate(a, b, 0.0));
    compare!(S, F, |a, b, c| Num::gate(a, b, 0.5));
    // The result may be rounded once or twice.
    let add = |[a, b, c]: [f32; 3], found| same(found, f32::mul_add(a, b, c));
    compare!(S, F, |a, b, c| MulAdd::mul_add(a, b, c), add);
}

fn operations<S: Token>() {
    operations_of::<S, f32x8<S>>();
    operations_of::<S, f32x16<S>>();
}

#[test]
fn every_operation_is_the_scalar_one() {
    on_each_level!(operations);
}

fn any_over<S: Token, F: Block<S>>() {
    let [values, ..] = pairs();
    let values: Vec<f32> = values.into_iter().step_by(5).collect();
    for least in [-1.0, 0.0, 0.5, 254.0, 255.0, f32::MAX] {
        for block in values.chunks_exact(F::WIDTH) {
            let loaded = F::load(S::get(), [block, &block[F::WIDTH - BLOCK..]], 0);
            let expected = block.iter().any(|&x| x > least);
            assert_eq!(loaded.any_over(least), expected, "{block:?} over {least}");
            let is_drawn = block.iter().any(|&x| x < f32::INFINITY);
            assert_eq!((-loaded).any_over(f32::NEG_INFINITY), is_drawn, "{block:?}");
        }
    }
    for k in 0..F::WIDTH {
        let mut block = [f32::INFINITY; 16];
        block[k] = 0.5;
        let loaded = F::load(
            S::get(),
            [&block[..F::WIDTH], &block[F::WIDTH - BLOCK..]],
            0,
        );
        assert!(!(-loaded).any_over(-0.5) && (-loaded).any_over(-0.6));
    }
}

#[test]
fn any_over_holds_if_one_lane_is_over() {
    fn of<S: Token>() {
        any_over::<S, f32x8<S>>();
        any_over::<S, f32x16<S>>();
    }
    on_each_level!(of);
}

/// A root and a quotient are each rounded once, by at most 2⁻²⁴ of their value. The quotient
/// inherits the root's error. 2⁻⁴⁸ is room for the product of both.
#[test]
fn inverse_roots_are_rounded_twice() {
    fn of<S: Token>() {
        let mut random = Random::new(5);
        let mut x = Vec::new();
        for exponent in -126..=127 {
            let power = f32::from_bits(((exponent + 127) as u32) << 23);
            let random = |i| 1.0 + (i as f32 + 0.5 * (1.0 + random.signed())) / 64.0;
            x.extend((0..64).map(random).map(|factor| power * factor));
            x.extend([
                power,
                power.next_up(),
                (power * 1.999_999).next_down(),
                1.5 * power,
            ]);
        }
        x.resize(x.len().next_multiple_of(16), 1.0);
        let bound = f64::powi(2.0, -23) + f64::powi(2.0, -47);
        let columns = [&x[..]; 3];
        let all = [
            blocks::<S, f32x8<S>>(columns, |x, _, _| x.rsqrt()),
            blocks::<S, f32x16<S>>(columns, |x, _, _| x.rsqrt()),
        ];
        for (found, x) in all.iter().flat_map(|found| found.iter().zip(&x)) {
            let error = (f64::from(*found) * f64::from(*x).sqrt() - 1.0).abs();
            assert!(error <= bound, "{x:e}: {error:.2e} is over {bound:.2e}");
        }
    }
    on_each_level!(of);
}

/// Returns values in 0..=1 that are 0 or normal: near 0, near 1, on both sides of the logarithm's
/// cut, and in between.
fn bases() -> Vec<f32> {
    let cut = core::f32::consts::FRAC_1_SQRT_2;
    let mut all = vec![0.0, f32::MIN_POSITIVE, 1e-30, 1.0, 1.0f32.next_down(), 0.5];
    all.extend([cut, cut.next_down(), cut.next_up()]);
    let mut random = Random::new(13);
    all.extend((0..1000).map(|_| random.signed().abs().max(f32::MIN_POSITIVE)));
    all.extend((0..400).map(|_| 1.0 - random.signed().abs() / 64.0));
    all.extend((0..400).map(|_| f32::powf(2.0, -126.0 * random.signed().abs())));
    all.resize(all.len().next_multiple_of(16), 0.75);
    all
}

#[test]
fn powers_are_as_near_as_the_documentation_says() {
    fn of<S: Token>() {
        let bases = bases();
        for n in [
            0.1f32, 0.5, 0.999, 1.0, 1.5, 2.0, 7.5, 20.25, 63.9, 128.0, 333.3, 1000.0,
        ] {
            let powers = blocks::<S, f32x8<S>>([&bases[..]; 3], |x, _, _| x.powf(n));
            let wide = blocks::<S, f32x16<S>>([&bases[..]; 3], |x, _, _| x.powf(n));
            assert_eq!(powers, wide);
            for (x, power) in bases.iter().zip(powers) {
                let (x, n) = (f64::from(*x), f64::from(n));
                let truth = x.powf(n);
                let logarithm = if x > 0.0 { x.log2().abs() * n } else { 0.0 };
                let reduced = f64::min(logarithm, 0.5 * n);
                let share = (0.7 * (logarithm + 3.0 * reduced) + 2.0) * f64::powi(2.0, -23);
                let error = (f64::from(power) - truth).abs();
                // Below the normal numbers only an absolute bound holds.
                let bound = truth * share + f64::powi(2.0, -126);
                assert!(error <= bound, "{x:e}^{n}: {power:e}, {truth:e}");
            }
        }
        let ends = [0.0, 1.0, 0.0, 1.0, 0.0, 1.0, 0.0, 1.0];
        let powers = |n: f32| blocks::<S, f32x8<S>>([&ends; 3], |x, _, _| x.powf(n));
        for n in [0.1, 1.0, 37.5] {
            assert_eq!(powers(n), ends, "0 and 1 to the power {n}");
        }
        assert_eq!(powers(0.0), [1.0; 8], "anything to the power 0");
    }
    on_each_level!(of);
}

const BACKGROUND: [u8; 4] = [10, 200, 255, 0];

/// Packs every level, both limits and their neighbours, levels outside 0..=255 and NaN, in each
/// channel.
fn packing<S: Token, F: Block<S>>() {
    let mut levels = vec![
        f32::NAN,
        -f32::NAN,
        -255.0,
        510.0,
        -0.0,
        1e-40,
        -1e-40,
        2e9,
        -2e9,
    ];
    for level in 0..=255u8 {
        let border = f32::from(level) + 0.5;
        levels.extend([
            f32::from(level),
            border,
            border.next_up(),
            border.next_down(),
        ]);
    }
    levels.resize(levels.len().next_multiple_of(F::WIDTH), 0.25);
    let count = levels.len();
    let turned = |by: usize| [&levels[by..], &levels[..by]].concat();
    let channels = [levels.clone(), turned(331), turned(77)];
    let mut random = Random::new(9);
    let depth: Vec<f32> = (0..count)
        .map(|_| {
            if random.signed() < 0.5 {
                random.signed()
            } else {
                f32::INFINITY
            }
        })
        .collect();
    let mut found = vec![[1, 2, 3, 4]; count + 5];
    for x in (0..count).step_by(F::WIDTH) {
        let load = |from: &Vec<f32>| {
            let from = &from[x..x + F::WIDTH];
            F::load(S::get(), [from, &from[F::WIDTH - BLOCK..]], 0)
        };
        F::pack(
            channels.each_ref().map(load),
            load(&depth),
            BACKGROUND,
            &mut found[x..],
        );
    }
    assert_eq!(
        found[count..],
        [[1, 2, 3, 4]; 5],
        "nothing behind the blocks is stored"
    );
    // The conversion turns NaN into 0.
    let byte = |level: f32| level.clamp(0.0, 255.0).round_ties_even() as u8;
    for i in 0..count {
        let [r, g, b] = channels.each_ref().map(|channel| byte(channel[i]));
        let expected = if depth[i] < f32::INFINITY {
            [r, g, b, 255]
        } else {
            BACKGROUND
        };
        let levels = channels.each_ref().map(|channel| channel[i]);
        assert_eq!(found[i], expected, "{levels:?}");
    }
}

#[test]
fn levels_are_stored_as_one_by_one() {
    fn of<S: Token>() {
        packing::<S, f32x8<S>>();
        packing::<S, f32x16<S>>();
    }
    on_each_level!(of);
}

#[test]
fn integers_of_lanes_are_those_of_the_processor() {
    fn of<S: Token>() {
        let m = Lanes(S::get());
        let ints = |x: i32x8<S>| {
            let mut to = [0; BLOCK];
            m.store_int(x, &mut to);
            to
        };
        let mut random = Random::new(7);
        for round in 0..2000 {
            let reach = [4, 300, 1 << 15][round % 3];
            let mut values = || [(); 8].map(|()| random.below(2 * reach + 1) as i32 - reach as i32);
            let (a, b) = (values(), values());
            let (x, y) = (m.load_int(&a), m.load_int(&b));
            let each =
                |of: fn(i32, i32) -> i32| -> [i32; 8] { core::array::from_fn(|k| of(a[k], b[k])) };
            assert_eq!(ints(x.less(y)), each(|a, b| if a < b { -1 } else { 0 }));
            let bits = (0..8).map(|k| u32::from(a[k] >= 0) << k).sum::<u32>();
            assert_eq!(
                (m.bits_not_negative(x), m.any_not_negative(x)),
                (bits, bits != 0)
            );
        }
        let all = [0, -1, 1, i32::MAX, i32::MIN, 16_777_217, -300, 256];
        let mut floats = [0.0; BLOCK];
        m.store(m.float(m.load_int(&all)), &mut floats);
        assert_eq!(floats, all.map(|x| x as f32), "rounded once");
        assert_eq!(ints(m.counted()), [0, 1, 2, 3, 4, 5, 6, 7]);
        let values = [0.0, -0.9, 1.9, -2.5, 1e6, -1e9, 2.147e9, 0.5];
        assert_eq!(ints(m.truncated(m.load(&values))), values.map(|x| x as i32));
        m.store(m.ramp(0.25, 1, 0.5), &mut floats);
        assert_eq!(floats, [0.75, 1.25, 1.75, 2.25, 2.75, 3.25, 3.75, 4.25]);
    }
    on_each_level!(of);
}

#[test]
fn lanes_are_selected_bit_by_bit() {
    fn of<S: Token>() {
        let m = Lanes(S::get());
        let [a, b, c] = pairs();
        for x in (0..a.len()).step_by(BLOCK) {
            let (old, new) = (m.load(&a[x..]), m.load(&b[x..]));
            let outside: [i32; BLOCK] = core::array::from_fn(|k| (c[x + k] * 4.0) as i32);
            let mut found = [0.0; BLOCK];
            // Neither depth may be NaN.
            let depth = |from: &[f32]| {
                from[x..x + BLOCK]
                    .iter()
                    .map(|x| if x.is_nan() { 0.0 } else { *x })
                    .collect::<Vec<_>>()
            };
            let (old_depth, new_depth) = (depth(&a), depth(&b));
            let mask = m.depth_mask(m.load_int(&outside), m.load(&new_depth), m.load(&old_depth));
            m.store(m.select(mask, old, new), &mut found);
            for k in 0..BLOCK {
                let is_kept = outside[k] < 0 || new_depth[k] >= old_depth[k];
                let expected = if is_kept { a[x + k] } else { b[x + k] };
                assert_eq!(
                    found[k].to_bits(),
                    expected.to_bits(),
                    "{} {} {}",
                    outside[k],
                    a[x + k],
                    b[x + k]
                );
            }
            m.store(m.where_less(old, new, m.splat(3.0)), &mut found);
            let expected = core::array::from_fn(|k| if a[x + k] < b[x + k] { 3.0 } else { 0.0 });
            assert_eq!(found, expected);
        }
    }
    on_each_level!(of);
}

#[test]
fn vectors_are_taken_apart_in_order() {
    fn of<S: Token>() {
        let all: [[f32; 3]; BLOCK] =
            core::array::from_fn(|k| core::array::from_fn(|i| (3 * k + i) as f32));
        let taken = deinterleaved(S::get())(&all);
        for (i, values) in [taken.x, taken.y, taken.z].into_iter().enumerate() {
            let values: [f32; BLOCK] = values.into();
            assert_eq!(values, all.map(|vector| vector[i]));
        }
    }
    on_each_level!(of);
}
