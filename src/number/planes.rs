//! Values as planes of plain numbers: how what a walk gives to a pixel is stored until its row is shaded.

/// A value that is made of numbers, which can be stored one beside the other and put together again.
pub trait Planes<F>: Copy {
    /// How many numbers it has; `None` where that depends on the value, which then cannot be stored as planes.
    const COUNT: Option<usize>;

    /// Gives its numbers in order; none where [`Planes::COUNT`] is `None`.
    #[inline(always)]
    fn put(self, to: &mut impl FnMut(F)) {
        let _ = to;
    }
    /// Takes as many numbers in the same order.
    ///
    /// # Panics
    /// Where [`Planes::COUNT`] is `None`.
    #[inline(always)]
    fn get(from: &mut impl FnMut() -> F) -> Self {
        let _ = from;
        unreachable!("a value that cannot be stored as planes")
    }
}

/// Gives the numbers of `value` in order. For closures that must be inlined, which only an argument itself can say.
#[inline(always)]
pub(crate) fn put_each<F, P: Planes<F>>(value: P, mut to: impl FnMut(F)) {
    value.put(&mut to);
}

/// Takes a value's numbers in order, likewise.
#[inline(always)]
pub(crate) fn get_each<F, P: Planes<F>>(mut from: impl FnMut() -> F) -> P {
    P::get(&mut from)
}

/// The sum of two counts, where both are known.
const fn sum(a: Option<usize>, b: Option<usize>) -> Option<usize> {
    match (a, b) {
        (Some(a), Some(b)) => Some(a + b),
        _ => None,
    }
}

impl<F: super::Num> Planes<F> for F {
    const COUNT: Option<usize> = Some(1);

    #[inline(always)]
    fn put(self, to: &mut impl FnMut(F)) {
        to(self);
    }
    #[inline(always)]
    fn get(from: &mut impl FnMut() -> F) -> Self {
        from()
    }
}

impl<F, P: Planes<F>, const L: usize> Planes<F> for [P; L] {
    const COUNT: Option<usize> = match P::COUNT {
        Some(count) => Some(L * count),
        None if L == 0 => Some(0),
        None => None,
    };

    #[inline(always)]
    fn put(self, to: &mut impl FnMut(F)) {
        let mut i = 0;
        while i < L {
            self[i].put(to);
            i += 1;
        }
    }
    #[inline(always)]
    fn get(from: &mut impl FnMut() -> F) -> Self {
        super::each(
            #[inline(always)]
            |_| P::get(from),
        )
    }
}

impl<F> Planes<F> for () {
    const COUNT: Option<usize> = Some(0);

    #[inline(always)]
    fn put(self, _: &mut impl FnMut(F)) {}
    #[inline(always)]
    fn get(_: &mut impl FnMut() -> F) -> Self {}
}

/// Whether there is a number is not known before the frame.
impl<F, P: Planes<F>> Planes<F> for Option<P> {
    const COUNT: Option<usize> = None;
}

macro_rules! tuple {
    ($($name:ident $place:tt),+) => {
        impl<F, $($name: Planes<F>),+> Planes<F> for ($($name,)+) {
            const COUNT: Option<usize> = {
                let count = Some(0);
                $(let count = sum(count, $name::COUNT);)+
                count
            };

            #[inline(always)]
            fn put(self, to: &mut impl FnMut(F)) {
                $(self.$place.put(to);)+
            }
            #[inline(always)]
            fn get(from: &mut impl FnMut() -> F) -> Self {
                ($($name::get(from),)+)
            }
        }
    };
}

tuple!(A 0, B 1);
tuple!(A 0, B 1, C 2);
tuple!(A 0, B 1, C 2, D 3);

#[cfg(test)]
mod tests {
    use super::*;
    use std::vec;
    use std::vec::Vec;

    fn planes(value: impl Planes<f32>) -> Vec<f32> {
        let mut all = Vec::new();
        put_each(value, |x| all.push(x));
        all
    }

    /// A value as planes and back again; as many planes as it says.
    #[track_caller]
    fn round_trip<P: Planes<f32> + PartialEq + core::fmt::Debug>(value: P, expected: &[f32]) {
        let stored = planes(value);
        assert_eq!(stored, expected);
        assert_eq!(P::COUNT, Some(stored.len()));
        let mut stored = stored.into_iter();
        assert_eq!(
            get_each::<f32, P>(|| stored.next().expect("as many numbers as were put")),
            value
        );
        assert_eq!(stored.next(), None, "all numbers are taken");
    }

    #[test]
    fn values_come_back_as_they_were_put() {
        round_trip(4.0, &[4.0]);
        round_trip((), &[]);
        round_trip([1.0, 2.0, 3.0], &[1.0, 2.0, 3.0]);
        round_trip([[1.0, 2.0], [3.0, 4.0]], &[1.0, 2.0, 3.0, 4.0]);
        round_trip(([1.0; 0], 5.0), &[5.0]);
        round_trip(([1.0, 2.0], 3.0, (4.0, 5.0)), &[1.0, 2.0, 3.0, 4.0, 5.0]);
        round_trip(
            (([1.0], (), 2.0), [(3.0, 4.0), (5.0, 6.0)], 7.0, ()),
            &[1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0],
        );
    }

    #[test]
    fn what_may_be_there_or_not_has_no_planes() {
        assert_eq!(<Option<f32> as Planes<f32>>::COUNT, None);
        assert_eq!(<(f32, Option<f32>) as Planes<f32>>::COUNT, None);
        assert_eq!(<[Option<f32>; 2] as Planes<f32>>::COUNT, None);
        assert_eq!(
            <[Option<f32>; 0] as Planes<f32>>::COUNT,
            Some(0),
            "none of them is there"
        );
        assert_eq!(planes((1.0, Some(2.0))), vec![1.0]);
    }
}
