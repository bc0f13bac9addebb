//! Groups of eight against the scalar machine, lane by lane, on every instruction set that this machine has.

use super::super::{Lanes, LanesJob, Level, Num, Scalar, on_level};
use crate::test_random::Random;
use std::vec;
use std::vec::Vec;

/// What is done with three numbers, on any machine.
trait Operation: Copy {
    fn of<M: Lanes>(self, m: M, a: M::F, b: M::F, c: M::F) -> M::F;
}

macro_rules! operation {
    ($name:ident, |$m:ident, $a:ident, $b:ident, $c:ident| $result:expr) => {
        #[derive(Clone, Copy)]
        struct $name;
        impl Operation for $name {
            #[allow(unused_variables)] // not every operation reads all of them
            fn of<M: Lanes>(self, $m: M, $a: M::F, $b: M::F, $c: M::F) -> M::F {
                $result
            }
        }
    };
}
operation!(Sum, |m, a, b, c| a + b);
operation!(Minus, |m, a, b, c| a - b);
operation!(Product, |m, a, b, c| a * b);
operation!(Quotient, |m, a, b, c| a / b);
operation!(Negative, |m, a, b, c| -a);
operation!(Root, |m, a, b, c| a.sqrt());
operation!(OverRoot, |m, a, b, c| a.over_sqrt());
operation!(Most, |m, a, b, c| Num::max(a, b));
operation!(Least, |m, a, b, c| Num::min(a, b));
operation!(Gate, |m, a, b, c| a.gate(b));
operation!(MulAdd, |m, a, b, c| Num::mul_add(a, b, c));
operation!(Less, |m, a, b, c| m.blend(m.less(a, b), m.splat(1.0), m.splat(0.0)));
operation!(Blend, |m, a, b, c| m.blend(m.less(c, m.splat(0.0)), a, b));
operation!(And, |m, a, b, c| m.blend(m.and(m.less(a, b), m.less(b, c)), a, c));
operation!(FromLargest, |m, a, b, c| m.ramp(m.first(a), m.first(b)));

/// An operation on columns of numbers, a group at a time.
struct Columns<'a, O> {
    operation: O,
    columns: [&'a [f32]; 3],
}

impl<O: Operation> LanesJob for Columns<'_, O> {
    type Out = Vec<f32>;

    fn run<M: Lanes>(self, m: M) -> Vec<f32> {
        let [a, b, c] = self.columns;
        let mut out = vec![0.0; a.len()];
        m.vectorize(|| {
            for x in (0..a.len()).step_by(M::WIDTH) {
                let result = self.operation.of(m, m.load(&a[x..]), m.load(&b[x..]), m.load(&c[x..]));
                m.store(result, &mut out[x..]);
            }
        });
        out
    }
}

/// The levels that shade eight pixels at a time.
fn wide() -> impl Iterator<Item = Level> {
    Level::available().filter(|level| level.width() > 1)
}

/// Numbers of every kind, and random ones: every pair of them, in whole groups.
fn pairs() -> [Vec<f32>; 3] {
    let mut numbers = vec![0.0, -0.0, 1.0, -1.0, 0.5, 255.0, 1e-40, f32::MIN_POSITIVE, -3e38, f32::MAX];
    numbers.extend([f32::INFINITY, f32::NEG_INFINITY, f32::NAN]);
    let mut random = Random::new(3);
    numbers.extend((0..11).map(|_| random.signed()));
    assert_eq!(numbers.len() % 8, 0);
    let (mut a, mut b, mut c) = (Vec::new(), Vec::new(), Vec::new());
    for &x in &numbers {
        for &y in &numbers {
            a.push(x);
            b.push(y);
            c.push(random.signed());
        }
    }
    [a, b, c]
}

/// Each result of `operation` on every level and on the scalar machine, with its three operands.
#[track_caller]
fn compare(operation: impl Operation, check: impl Fn([f32; 3], f32, f32) -> bool) {
    let columns = pairs();
    let columns = columns.each_ref().map(|column| &column[..]);
    let expected = on_level(Level::Scalar, Columns { operation, columns });
    for level in wide() {
        let found = on_level(level, Columns { operation, columns });
        for (i, (found, expected)) in found.into_iter().zip(&expected).enumerate() {
            let operands = columns.map(|column| column[i]);
            assert!(check(operands, found, *expected), "{level}, {operands:?}: {found}, expected {expected}");
        }
    }
}

fn same(found: f32, expected: f32) -> bool {
    found == expected || (found.is_nan() && expected.is_nan())
}

#[test]
fn every_operation_is_the_scalar_one() {
    let exact = |_: [f32; 3], found, expected| same(found, expected);
    compare(Sum, exact);
    compare(Minus, exact);
    compare(Product, exact);
    compare(Quotient, exact);
    compare(Root, exact);
    // What is moved and not computed stays as it is to the last bit.
    let moved = |_: [f32; 3], found: f32, expected: f32| found.to_bits() == expected.to_bits();
    compare(Negative, moved);
    compare(Less, moved);
    compare(Blend, moved);
    compare(And, moved);
    compare(Gate, moved);
}

/// A NaN that is clamped becomes what it is clamped to; bounds themselves are numbers.
#[test]
fn clamps_make_numbers_of_what_is_none() {
    let clamped = |[_, bound, _]: [f32; 3], found, expected| bound.is_nan() || same(found, expected);
    compare(Most, clamped);
    compare(Least, clamped);
    let bounded = |[x, bound, _]: [f32; 3], found, _| !x.is_nan() || same(found, bound);
    compare(Most, bounded);
    compare(Least, bounded);
}

/// Rounded once or twice, as the machine has it; a ramp counts lanes from 0.
#[test]
fn sums_of_products_are_rounded_once_or_twice() {
    let fused = |[a, b, c]: [f32; 3], found, expected| same(found, expected) || same(found, f32::mul_add(a, b, c));
    compare(MulAdd, fused);
    let columns = pairs();
    let columns = columns.each_ref().map(|column| &column[..]);
    for level in wide() {
        let found = on_level(level, Columns { operation: FromLargest, columns });
        for (i, found) in found.into_iter().enumerate() {
            let (at, step, k) = (columns[0][i / 8 * 8], columns[1][i / 8 * 8], (i % 8) as f32);
            assert!(
                same(found, k * step + at) || same(found, k.mul_add(step, at)),
                "{level}: {at} + {k} · {step}: {found}"
            );
        }
    }
}

/// Over the whole range of exponents: with the estimate off by e = 1.5 · 2⁻¹² at most, Newton's step leaves 1.5 e²; the
/// products y/2 x y and their difference from 3/2, which is 1, and the last product are rounded four times by 2⁻²⁴ of 1 at
/// most, two of them halved. Without an estimate a root and a quotient are rounded.
#[test]
fn inverse_roots_are_off_by_less_than_two_to_the_minus_21() {
    let mut random = Random::new(5);
    let mut x = Vec::new();
    for exponent in -126..=127 {
        let power = f32::from_bits(((exponent + 127) as u32) << 23);
        x.extend((0..64).map(|i| power * (1.0 + (i as f32 + 0.5 * (1.0 + random.signed())) / 64.0)));
        x.extend([power, power.next_up(), (power * 1.999_999).next_down(), 1.5 * power]);
    }
    x.resize(x.len().next_multiple_of(8), 1.0);
    let estimate = 1.5 * f64::powi(2.0, -12);
    let rounding = f64::powi(2.0, -24);
    let bound = 1.5 * estimate * estimate + 3.0 * rounding;
    assert!(bound < f64::powi(2.0, -21));
    for level in wide() {
        let found = on_level(level, Columns { operation: OverRoot, columns: [&x, &x, &x] });
        let error = |(found, x): (&f32, &f32)| (f64::from(*found) * f64::from(*x).sqrt() - 1.0).abs();
        let most = found.iter().zip(&x).map(error).fold(0.0, f64::max);
        let bound = if level == Level::Avx2 { bound } else { 2.0 * rounding };
        assert!(most <= bound, "{level}: {most:.2e} is over {bound:.2e}");
    }
}

/// Masks of the first lanes, and whether any lane is meant.
struct FirstLanes(usize);

impl LanesJob for FirstLanes {
    type Out = (Vec<f32>, bool);

    fn run<M: Lanes>(self, m: M) -> (Vec<f32>, bool) {
        let mut lanes = vec![0.0; M::WIDTH];
        let mask = m.first_lanes(self.0);
        m.store(m.blend(mask, m.splat(1.0), m.splat(0.0)), &mut lanes);
        (lanes, m.any(mask))
    }
}

#[test]
fn first_lanes_are_the_first() {
    for level in Level::available() {
        for n in (0..20).chain([usize::MAX / 2]) {
            let (lanes, any) = on_level(level, FirstLanes(n));
            assert_eq!(lanes.len(), level.width());
            assert!(lanes.iter().enumerate().all(|(k, &lane)| lane == f32::from(k < n)), "{level}: {n}: {lanes:?}");
            assert_eq!(any, n > 0);
        }
    }
}

/// Values of a recurrence in order, a stride, and a memory that is larger than a group.
struct Made;

impl LanesJob for Made {
    type Out = (Vec<f32>, f32);

    fn run<M: Lanes>(self, m: M) -> (Vec<f32>, f32) {
        let mut next = 1.0f32;
        let taken = m.take(|| {
            next *= 2.0;
            next
        });
        let mut to = vec![-1.0; M::WIDTH + 3];
        m.store(taken, &mut to);
        (to, m.first(m.stride(3.0)))
    }
}

#[test]
fn groups_are_made_in_order() {
    for level in Level::available() {
        let (values, stride) = on_level(level, Made);
        let width = level.width();
        assert!((0..width).all(|k| values[k] == f32::powi(2.0, k as i32 + 1)), "{level}: {values:?}");
        assert_eq!(values[width..], [-1.0; 3], "{level}: nothing behind the group is stored");
        assert_eq!(stride, 3.0 * width as f32);
    }
}

/// Edge functions of eight neighbouring pixels.
struct Inside([i32; 3], [i32; 3]);

impl LanesJob for Inside {
    type Out = u32;

    fn run<M: Lanes>(self, m: M) -> u32 {
        // From one pixel before, so that going beside is seen too.
        let start = [0, 1, 2].map(|i| self.0[i] - self.1[i]);
        m.inside(m.beside(m.edges(start, self.1), self.1))
    }
}

#[test]
fn eight_pixels_are_inside_where_three_functions_are_not_negative() {
    let mut random = Random::new(7);
    for round in 0..20_000 {
        // As far as the engine goes: below 2³¹ with all that is added.
        let reach = [4, 300, 1 << 16, 1 << 27][round % 4];
        let mut number = |reach: u64| random.below(2 * reach + 1) as i32 - reach as i32;
        let at = [(); 3].map(|()| number(reach));
        let step = [(); 3].map(|()| number((reach / 4).max(2)));
        let inside = |k: i32| (0..3).all(|i| i64::from(at[i]) + i64::from(k) * i64::from(step[i]) >= 0);
        let expected = (0..8).map(|k| u32::from(inside(k)) << k).sum::<u32>();
        for level in Level::available() {
            assert_eq!(on_level(level, Inside(at, step)), expected, "{level}: {at:?} {step:?}");
        }
    }
}

/// Colours as bytes: of every pixel whether it is covered.
struct Packed<'a> {
    channels: [&'a [f32]; 3],
    covered: &'a [f32],
}

const BACKGROUND: [u8; 4] = [10, 200, 255, 0];

impl LanesJob for Packed<'_> {
    type Out = Vec<[u8; 4]>;

    fn run<M: Lanes>(self, m: M) -> Vec<[u8; 4]> {
        let mut to = vec![[1, 2, 3, 4]; self.covered.len() + 5];
        for x in (0..self.covered.len()).step_by(M::WIDTH) {
            let covered = m.less(m.load(&self.covered[x..]), m.splat(0.0));
            let rgb = self.channels.map(|channel| m.load(&channel[x..]));
            m.pack(rgb, covered, BACKGROUND, &mut to[x..]);
        }
        to
    }
}

/// Every level's own value, both borders and their neighbours, values outside of 0..=1 and no numbers, in each channel.
#[test]
fn colours_are_stored_as_one_by_one() {
    let mut values: Vec<f32> =
        vec![f32::NAN, -f32::NAN, f32::INFINITY, f32::NEG_INFINITY, -1.0, 2.0, -0.0, 1e-40, -1e-40];
    for level in 0..=255u16 {
        let border = ((f64::from(level) + 0.5) / 255.0) as f32;
        values.extend([f32::from(level) / 255.0, border, border.next_up(), border.next_down()]);
    }
    values.resize(values.len().next_multiple_of(8), 0.25);
    let turned = |by: usize| -> Vec<f32> { values.iter().cycle().skip(by).take(values.len()).copied().collect() };
    let (green, blue) = (turned(331), turned(77));
    let mut random = Random::new(9);
    let covered: Vec<f32> = values.iter().map(|_| random.signed() + 0.5).collect();
    let packed = |level| on_level(level, Packed { channels: [&values, &green, &blue], covered: &covered });
    let expected = packed(Level::Scalar);
    assert!(expected.contains(&BACKGROUND) && expected.iter().any(|t| t[3] == 255));
    for level in wide() {
        let found = packed(level);
        for (i, (found, expected)) in found.iter().zip(&expected).enumerate() {
            let rgb = (values.get(i), green.get(i), blue.get(i));
            assert_eq!(found, expected, "{level} at {i}: {rgb:?}");
        }
    }
    let [nan, infinite] = [f32::NAN, f32::INFINITY].map(|c| {
        let mut to = [[0; 4]];
        Scalar.pack([c; 3], true, BACKGROUND, &mut to);
        to[0]
    });
    assert_eq!((nan, infinite), ([0, 0, 0, 255], [255; 4]));
}
