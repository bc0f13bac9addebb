//! Products with names, where lights or the eye are at positions: in a tuple of six, readers would
//! have to count parentheses.

/// Defines a structure of named products, some of them one per light. It implements `Values` if it
/// holds values, and `Walk` if it holds walks.
macro_rules! products {
    ($(#[$about:meta])* $name:ident { $($(#[$of_one:meta])* $one:ident),* } per light { $($(#[$of_each:meta])* $each:ident),* }) => {
        $(#[$about])*
        #[derive(Clone, Copy, Debug)]
        pub struct $name<T, const L: usize> {
            $($(#[$of_one])* pub $one: T,)*
            $($(#[$of_each])* pub $each: PerLight<T, L>,)*
        }

        impl<T: Copy, const L: usize> $name<T, L> {
            /// Makes room for the products of `lights` lights.
            #[inline(always)]
            pub fn new(lights: usize, first: T) -> Self {
                $name {
                    $($one: first,)*
                    $($each: PerLight::new(lights, first),)*
                }
            }
        }

        impl<F: Num, const L: usize> $crate::shading::Values<F> for $name<F, L> {
            #[inline(always)]
            fn filled(lights: usize, value: F) -> Self {
                Self::new(lights, value)
            }
            #[inline(always)]
            fn each(&mut self, next: &mut usize, to: &mut impl FnMut(usize, &mut F)) {
                $(self.$one.each(next, to);)*
                $(self.$each.each(next, to);)*
            }
            #[inline(always)]
            fn zip(&mut self, other: Self, of: impl Fn(F, F) -> F + Copy) {
                $(self.$one.zip(other.$one, of);)*
                $(self.$each.zip(other.$each, of);)*
            }
        }

        impl<F: Num, W: $crate::shading::Walk<F, Pixel = F>, const L: usize> $crate::shading::Walk<F> for $name<W, L> {
            type Pixel = $name<F, L>;
            const REMEMBERS: bool = W::REMEMBERS;

            #[inline(always)]
            fn next(&mut self) -> Self::Pixel {
                $name {
                    $($one: self.$one.next(),)*
                    $($each: self.$each.next(),)*
                }
            }
            fn inside(&self, see: &mut dyn FnMut(&'static str, F)) {
                $(self.$one.inside(see);)*
                $(self.$each.inside(see);)*
            }
        }
    };
}
pub(crate) use products;
