//! Varyings: values of a vertex that spans interpolate.

use super::increments::{GreatCircle, Linear, Sines};
use super::planes::{Planes, planes};
use crate::number::{Num, Vec3};

/// A value of a vertex, and its interpolation along a span.
pub trait Varying<F: Num>: Planes<F> {
    /// The start of a span: [`Linear`], or [`GreatCircle`] for unit normals.
    type Span: Planes<F>;
    /// True if edges and spans are great circles.
    const GREAT_CIRCLE: bool = false;
}

/// A unit normal, interpolated along the great circle at uniform speed (L21 4.7).
#[derive(Clone, Copy, Debug)]
pub struct UnitNormal<F>(pub Vec3<F>);

planes!([V] Linear<V>, { at: V, step: V }, |at, step| Linear { at, step });
planes!([] UnitNormal<F>, { 0: Vec3<F> }, UnitNormal);
planes!([] GreatCircle<F>, { from: Vec3<F>, to: Vec3<F>, sines: Sines<F> },
    |from, to, sines| Self { from, to, sines });
planes!([] Sines<F>, { t: (F, F), rest: (F, F), step: (F, F) },
    |t, rest, step| Self { t, rest, step });

impl<F: Num> Varying<F> for UnitNormal<F> {
    type Span = GreatCircle<F>;
    const GREAT_CIRCLE: bool = true;
}

impl<F: Num> Varying<F> for Vec3<F> {
    type Span = Linear<Self>;
}

impl<F: Num, A: Planes<F>, B: Planes<F>> Varying<F> for (A, B) {
    type Span = Linear<Self>;
}

impl<F: Num, A: Planes<F>, B: Planes<F>, C: Planes<F>> Varying<F> for (A, B, C) {
    type Span = Linear<Self>;
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::shading::planes::{PerLight, count, each};
    use alloc::vec::Vec;

    /// Puts a value and takes it back, where there are `lights` lights; returns its numbers.
    fn put_and_taken<P: Planes<f32>>(lights: usize, value: P) -> Vec<f32> {
        let all = |value: P| {
            let mut all = Vec::new();
            each(value, |_, x: &mut f32| all.push(*x));
            all
        };
        let numbers = all(value);
        assert_eq!(count::<P>(lights), numbers.len());
        let back = each(P::filled(lights, 0.0), |i, x| *x = numbers[i]);
        assert_eq!(all(back), numbers);
        let twice: Vec<f32> = numbers.iter().map(|x| x + x).collect();
        let mut sum = value;
        sum.zip(back, |a, b| a + b);
        assert_eq!(all(sum), twice);
        numbers
    }

    #[test]
    fn values_come_back_as_they_were_put() {
        let v = |x: f32| Vec3 {
            x,
            y: x + 1.0,
            z: x + 2.0,
        };
        assert_eq!(put_and_taken(1, 4.0), [4.0]);
        assert_eq!(put_and_taken(1, v(1.0)), [1.0, 2.0, 3.0]);
        assert_eq!(put_and_taken(1, UnitNormal(v(1.0))), [1.0, 2.0, 3.0]);
        assert_eq!(put_and_taken(1, (1.0, v(2.0))), [1.0, 2.0, 3.0, 4.0]);
        assert_eq!(
            put_and_taken(1, (1.0, 2.0, (3.0, 4.0))),
            [1.0, 2.0, 3.0, 4.0]
        );
        let linear = Linear {
            at: (1.0, 2.0),
            step: (3.0, 4.0),
        };
        assert_eq!(put_and_taken(1, linear), [1.0, 2.0, 3.0, 4.0]);
        let sines = Sines {
            t: (7.0, 8.0),
            rest: (9.0, 10.0),
            step: (11.0, 12.0),
        };
        let circle = GreatCircle {
            from: v(1.0),
            to: v(4.0),
            sines,
        };
        let numbers: Vec<f32> = (1..=12).map(|x| x as f32).collect();
        assert_eq!(put_and_taken(1, circle), numbers);
    }

    /// Of few lights all that there is room for are stepped, of many as many as there are.
    #[test]
    fn there_is_a_number_for_each_light() {
        fn of<const L: usize>(lights: usize) -> Vec<f32> {
            let mut all = PerLight::<f32, L>::new(lights, 0.5);
            (0..lights).for_each(|i| all.values[i] = i as f32);
            put_and_taken(lights, all)
        }
        assert_eq!(of::<1>(1), [0.0]);
        assert_eq!(of::<4>(3), [0.0, 1.0, 2.0, 0.5]);
        assert_eq!(of::<64>(3), [0.0, 1.0, 2.0]);
        assert_eq!(of::<64>(64).len(), 64);
    }
}
