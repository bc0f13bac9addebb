//! Groups of eight against the scalar machine, lane by lane, on every instruction set that this machine has.

use super::super::{Int, Lanes, LanesJob, Level, Num, on_level};
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
operation!(Less, |m, a, b, c| m.blend(
    m.less(a, b),
    m.splat(1.0),
    m.splat(0.0)
));
operation!(Blend, |m, a, b, c| m.blend(m.less(c, m.splat(0.0)), a, b));
operation!(Kept, |m, a, b, c| m.keep(
    m.kept(m.truncated(c * m.splat(4.0)), a, b),
    a,
    c
));
operation!(Truncated, |m, a, b, c| m
    .number(m.truncated(c * m.splat(1e6))));
operation!(MulSub, |m, a, b, c| Num::mul_sub(a, b, c));
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
                let result =
                    self.operation
                        .of(m, m.load(&a[x..]), m.load(&b[x..]), m.load(&c[x..]));
                m.store(result, &mut out[x..]);
            }
        });
        out
    }
}

/// The levels that shade eight pixels at a time.
pub(super) fn wide() -> impl Iterator<Item = Level> {
    Level::available().filter(|level| level.width() > 1)
}

/// Numbers of every kind, and random ones: every pair of them, in whole groups.
fn pairs() -> [Vec<f32>; 3] {
    let mut numbers = vec![
        0.0,
        -0.0,
        1.0,
        -1.0,
        0.5,
        255.0,
        1e-40,
        f32::MIN_POSITIVE,
        -3e38,
        f32::MAX,
    ];
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
            assert!(
                check(operands, found, *expected),
                "{level}, {operands:?}: {found}, expected {expected}"
            );
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
    let kept = |[a, b, _]: [f32; 3], found: f32, expected: f32| {
        a.is_nan() || b.is_nan() || found.to_bits() == expected.to_bits()
    };
    compare(Kept, kept);
    compare(Truncated, moved);
    compare(Gate, moved);
}

/// A NaN that is clamped becomes what it is clamped to; bounds themselves are numbers.
#[test]
fn clamps_make_numbers_of_what_is_none() {
    let clamped =
        |[_, bound, _]: [f32; 3], found, expected| bound.is_nan() || same(found, expected);
    compare(Most, clamped);
    compare(Least, clamped);
    let bounded = |[x, bound, _]: [f32; 3], found, _| !x.is_nan() || same(found, bound);
    compare(Most, bounded);
    compare(Least, bounded);
}

/// Of each number whether any of its group is over the limit.
struct AnyOver<'a>(&'a [f32], f32);

impl LanesJob for AnyOver<'_> {
    type Out = Vec<bool>;

    fn run<M: Lanes>(self, m: M) -> Vec<bool> {
        let groups = self.0.chunks_exact(M::WIDTH);
        groups
            .flat_map(|group| vec![m.load(group).is_over(m.splat(self.1)); M::WIDTH])
            .collect()
    }
}

#[test]
fn a_group_is_over_what_any_of_it_is_over() {
    let [numbers, ..] = pairs();
    let numbers: Vec<f32> = numbers.into_iter().step_by(5).collect();
    let numbers = &numbers[..numbers.len() / 8 * 8];
    for least in [-1.0, 0.0, 0.5, 254.0, 255.0, f32::MAX] {
        for level in wide() {
            let found = on_level(level, AnyOver(numbers, least));
            for (group, found) in numbers.chunks_exact(8).zip(found.chunks_exact(8)) {
                let expected = group.iter().any(|&x| x > least);
                assert_eq!(found, [expected; 8], "{level}: {group:?} over {least}");
            }
        }
    }
}

/// Rounded once or twice, as the machine has it; a ramp counts lanes from 0.
#[test]
fn sums_of_products_are_rounded_once_or_twice() {
    let fused = |[a, b, c]: [f32; 3], found, expected| {
        same(found, expected) || same(found, f32::mul_add(a, b, c))
    };
    compare(MulAdd, fused);
    let fused = |[a, b, c]: [f32; 3], found, expected| {
        same(found, expected) || same(found, f32::mul_add(a, b, -c))
    };
    compare(MulSub, fused);
    let columns = pairs();
    let columns = columns.each_ref().map(|column| &column[..]);
    for level in wide() {
        let found = on_level(
            level,
            Columns {
                operation: FromLargest,
                columns,
            },
        );
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
        x.extend(
            (0..64).map(|i| power * (1.0 + (i as f32 + 0.5 * (1.0 + random.signed())) / 64.0)),
        );
        x.extend([
            power,
            power.next_up(),
            (power * 1.999_999).next_down(),
            1.5 * power,
        ]);
    }
    x.resize(x.len().next_multiple_of(8), 1.0);
    let estimate = 1.5 * f64::powi(2.0, -12);
    let rounding = f64::powi(2.0, -24);
    let bound = 1.5 * estimate * estimate + 3.0 * rounding;
    assert!(bound < f64::powi(2.0, -21));
    for level in wide() {
        let found = on_level(
            level,
            Columns {
                operation: OverRoot,
                columns: [&x, &x, &x],
            },
        );
        let error =
            |(found, x): (&f32, &f32)| (f64::from(*found) * f64::from(*x).sqrt() - 1.0).abs();
        let most = found.iter().zip(&x).map(error).fold(0.0, f64::max);
        let bound = if level == Level::Avx2 {
            bound
        } else {
            2.0 * rounding
        };
        assert!(most <= bound, "{level}: {most:.2e} is over {bound:.2e}");
    }
}

/// Masks of some neighbouring lanes: as numbers, whether any lane is meant, and as bits.
struct SomeLanes(usize, usize);

impl LanesJob for SomeLanes {
    type Out = (Vec<f32>, bool, u32);

    fn run<M: Lanes>(self, m: M) -> Self::Out {
        let mut lanes = vec![0.0; M::WIDTH];
        let mask = m.lanes(self.0, self.1);
        m.store(m.blend(mask, m.splat(1.0), m.splat(0.0)), &mut lanes);
        (lanes, m.any(mask), m.bits(mask))
    }
}

#[test]
fn lanes_are_those_from_and_before() {
    let ends = || (0..12).chain([usize::MAX / 2]);
    for level in Level::available() {
        for (from, to) in ends().flat_map(|from| ends().map(move |to| (from, to))) {
            let (lanes, any, bits) = on_level(level, SomeLanes(from, to));
            assert_eq!(lanes.len(), level.width());
            let expected: Vec<bool> = (0..level.width())
                .map(|k| (from..to).contains(&k))
                .collect();
            let of_lanes = lanes.iter().map(|&lane| lane == 1.0);
            assert!(
                of_lanes.eq(expected.iter().copied()),
                "{level}: {from}..{to}: {lanes:?}"
            );
            assert_eq!(any, expected.contains(&true), "{level}: {from}..{to}");
            assert!(
                (0..level.width()).all(|k| (bits >> k & 1 == 1) == expected[k]),
                "{level}: {from}..{to}: {bits:b}"
            );
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
        assert!(
            (0..width).all(|k| values[k] == f32::powi(2.0, k as i32 + 1)),
            "{level}: {values:?}"
        );
        assert_eq!(
            values[width..],
            [-1.0; 3],
            "{level}: nothing behind the group is stored"
        );
        assert_eq!(stride, 3.0 * width as f32);
    }
}

/// Whole numbers through every operation.
struct Integers([i32; 8], [i32; 8]);

impl LanesJob for Integers {
    /// By operation the results of all pairs.
    type Out = [Vec<i32>; 9];

    fn run<M: Lanes>(self, m: M) -> Self::Out {
        let mut out: Self::Out = Default::default();
        for first in (0..8).step_by(M::WIDTH) {
            let (a, b) = (m.load_int(&self.0[first..]), m.load_int(&self.1[first..]));
            let less = a.less(b);
            let results = [
                a + b,
                a - b,
                a * b,
                a.min(b),
                a.max(b),
                a.whole_pixels(),
                less,
                M::I::choose(less, b, m.int(7)),
                a & b,
            ];
            for (out, result) in out.iter_mut().zip(results) {
                let mut group = [0; 8];
                m.store_int(result, &mut group);
                out.extend(&group[..M::WIDTH]);
            }
        }
        out
    }
}

#[test]
fn whole_numbers_are_those_of_the_processor() {
    let mut random = Random::new(7);
    for round in 0..2000 {
        // As far as the engine goes: no product over 2³¹.
        let reach = [4, 300, 1 << 15][round % 3];
        let mut numbers = || [(); 8].map(|()| random.below(2 * reach + 1) as i32 - reach as i32);
        let (a, b) = (numbers(), numbers());
        let each = |of: fn(i32, i32) -> i32| -> Vec<i32> {
            a.iter().zip(b).map(|(&a, b)| of(a, b)).collect()
        };
        let expected = [
            each(|a, b| a + b),
            each(|a, b| a - b),
            each(|a, b| a * b),
            each(Ord::min),
            each(Ord::max),
            each(|a, _| a.div_euclid(256)),
            each(|a, b| if a < b { -1 } else { 0 }),
            each(|a, b| if a < b { b } else { 7 }),
            each(|a, b| a & b),
        ];
        for level in Level::available() {
            assert_eq!(
                on_level(level, Integers(a, b)),
                expected,
                "{level}: {a:?} {b:?}"
            );
        }
    }
}

/// Which whole numbers are 0 or more, what they are as numbers, and counted ones.
struct Signs([i32; 8]);

impl LanesJob for Signs {
    type Out = (u32, Vec<f32>, i32);

    fn run<M: Lanes>(self, m: M) -> Self::Out {
        let (mut bits, mut numbers, mut counted) = (0, vec![], [0; 8]);
        m.store_int(m.counted(), &mut counted);
        for first in (0..8).step_by(M::WIDTH) {
            let group = m.load_int(&self.0[first..]);
            bits |= (m.bits(m.not_negative(group)) & ((1 << M::WIDTH) - 1)) << first;
            let mut group_numbers = [0.0; 8];
            m.store(m.number(group), &mut group_numbers);
            numbers.extend(&group_numbers[..M::WIDTH]);
        }
        (bits, numbers, counted[M::WIDTH - 1])
    }
}

#[test]
fn signs_and_numbers_of_whole_numbers() {
    let all = [0, -1, 1, i32::MAX, i32::MIN, 16_777_217, -300, 256];
    for level in Level::available() {
        let (bits, numbers, last) = on_level(level, Signs(all));
        assert_eq!(bits, 0b1010_1101, "{level}");
        assert_eq!(numbers, all.map(|x| x as f32), "{level}: rounded once");
        assert_eq!(last, level.width() as i32 - 1, "{level}");
    }
}
