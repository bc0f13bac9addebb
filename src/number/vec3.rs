//! Vectors of three components.

use super::Num;
use core::ops::{Add, Mul, Sub};

/// Three components: a normal, a direction, a position or a colour.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Vec3<F> {
    /// x, or red.
    pub x: F,
    /// y, or green.
    pub y: F,
    /// z, or blue.
    pub z: F,
}

/// Makes a vector from an array.
#[inline(always)]
pub const fn vec3<F: Copy>([x, y, z]: [F; 3]) -> Vec3<F> {
    Vec3 { x, y, z }
}

impl<F: Add<G, Output = F> + Copy, G> Add<Vec3<G>> for Vec3<F> {
    type Output = Self;
    #[inline(always)]
    fn add(self, o: Vec3<G>) -> Self {
        vec3([self.x + o.x, self.y + o.y, self.z + o.z])
    }
}

impl<F: Sub<G, Output = F> + Copy, G> Sub<Vec3<G>> for Vec3<F> {
    type Output = Self;
    #[inline(always)]
    fn sub(self, o: Vec3<G>) -> Self {
        vec3([self.x - o.x, self.y - o.y, self.z - o.z])
    }
}

impl<F: Mul<G, Output = F> + Copy, G: Copy> Mul<G> for Vec3<F> {
    type Output = Self;
    #[inline(always)]
    fn mul(self, s: G) -> Self {
        vec3([self.x * s, self.y * s, self.z * s])
    }
}

impl<F: Num> Vec3<F> {
    /// Returns the dot product.
    #[inline(always)]
    pub fn dot(self, o: Self) -> F {
        self.z.mul_add(o.z, self.y.mul_add(o.y, self.x * o.x))
    }

    /// Returns `self + s · v`, with fused multiply-adds where the backend has them.
    #[inline(always)]
    pub fn plus(self, s: F, v: Vec3<f32>) -> Self {
        let v = v.broadcast(s);
        vec3([
            s.mul_add(v.x, self.x),
            s.mul_add(v.y, self.y),
            s.mul_add(v.z, self.z),
        ])
    }

    /// Returns the vector divided by its length. The length must not be 0.
    #[inline(always)]
    pub fn unit(self) -> Self {
        let square = self.dot(self);
        self * (square.broadcast(1.0) / square.sqrt())
    }

    /// Returns the components.
    #[inline(always)]
    pub fn array(self) -> [F; 3] {
        [self.x, self.y, self.z]
    }
}

impl Vec3<f32> {
    /// Returns the vector with equal components in all lanes of a value like `like`.
    #[inline(always)]
    pub fn broadcast<F: Num>(self, like: F) -> Vec3<F> {
        vec3([
            like.broadcast(self.x),
            like.broadcast(self.y),
            like.broadcast(self.z),
        ])
    }
}
