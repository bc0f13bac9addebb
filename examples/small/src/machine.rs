//! The machine: how it starts, prints and ends, and the marks between which instructions are
//! counted.
//!
//! On a machine with an operating system these functions print and end as usual, so that
//! checksums can be compared.

use core::cell::UnsafeCell;
use core::sync::atomic::{AtomicBool, Ordering};

/// A line of text of at most 120 bytes.
pub struct Line {
    bytes: [u8; 122],
    length: usize,
}

impl Line {
    pub fn new() -> Self {
        Self {
            bytes: [0; 122],
            length: 0,
        }
    }
    pub fn text(mut self, text: &str) -> Self {
        for byte in text.bytes() {
            if self.length < 120
                && let Some(place) = self.bytes.get_mut(self.length)
            {
                *place = byte;
                self.length += 1;
            }
        }
        self
    }
    pub fn number(mut self, mut x: u32) -> Self {
        let mut digits = [0; 10];
        for digit in digits.iter_mut().rev() {
            *digit = b'0' + (x % 10) as u8;
            x /= 10;
        }
        let mut is_leading = true;
        for (i, digit) in digits.into_iter().enumerate() {
            is_leading &= digit == b'0' && i < 9;
            if !is_leading
                && self.length < 120
                && let Some(place) = self.bytes.get_mut(self.length)
            {
                *place = digit;
                self.length += 1;
            }
        }
        self
    }
}

/// Static memory that the program takes once and then keeps.
pub struct Memory<T> {
    is_taken: AtomicBool,
    value: UnsafeCell<T>,
}

// SAFETY: only the caller that finds `is_taken` unset gets a reference. The bare machine has one
// thread and no interrupts, so a load and a store are enough.
unsafe impl<T: Send> Sync for Memory<T> {}

impl<T> Memory<T> {
    pub const fn new(value: T) -> Self {
        Self {
            is_taken: AtomicBool::new(false),
            value: UnsafeCell::new(value),
        }
    }
    /// Returns the memory, or `None` if it was taken before.
    #[expect(clippy::mut_from_ref, reason = "only the first call returns it")]
    pub fn take(&'static self) -> Option<&'static mut T> {
        if self.is_taken.load(Ordering::Relaxed) {
            return None;
        }
        self.is_taken.store(true, Ordering::Relaxed);
        // SAFETY: this is the only reference, see above.
        Some(unsafe { &mut *self.value.get() })
    }
}

/// Adds a value to a checksum (FNV-1a).
pub fn checksum(sum: u32, x: u32) -> u32 {
    (sum ^ x).wrapping_mul(16_777_619)
}
/// The checksum of no values.
pub const NOTHING: u32 = 2_166_136_261;

#[cfg(target_os = "none")]
mod bare {
    use super::Line;
    use core::arch::{asm, global_asm};

    #[cfg(target_arch = "arm")]
    global_asm!(
        ".section .vectors,\"a\"",
        ".word stack_top",
        ".word start",
        ".word fault",
        ".word fault",
        ".text",
        ".thumb",
        ".thumb_func",
        ".global start",
        "start:",
        "bl run",
        "b .",
        ".thumb_func",
        "fault:",
        "bl stop_at_fault",
        "b .",
    );
    #[cfg(target_arch = "riscv32")]
    global_asm!(
        ".section .text.start,\"ax\"",
        ".global start",
        "start:",
        "la sp, stack_top",
        "la t0, 1f",
        "csrw mtvec, t0",
        "call run",
        ".balign 4",
        "1: call stop_at_fault",
    );

    /// Calls the debugger of the machine, which is QEMU here.
    #[inline(never)]
    fn semihosting(operation: u32, argument: *const u32) {
        // SAFETY: the debugger only reads what the argument points to.
        unsafe {
            #[cfg(target_arch = "arm")]
            asm!("bkpt 0xab", inout("r0") operation => _, in("r1") argument);
            #[cfg(target_arch = "riscv32")]
            asm!(
                ".balign 16",
                ".option push",
                ".option norvc",
                "slli x0, x0, 0x1f",
                "ebreak",
                "srai x0, x0, 7",
                ".option pop",
                inout("a0") operation => _,
                in("a1") argument
            );
        }
    }

    pub fn end(is_well: bool) -> ! {
        let reason = [0x20026, u32::from(!is_well)];
        semihosting(0x20, reason.as_ptr());
        semihosting(0x18, 0x20026 as *const u32);
        loop {}
    }

    impl Line {
        pub fn print(mut self) {
            if let Some(end) = self.bytes.get_mut(self.length) {
                *end = b'\n';
            }
            semihosting(4, self.bytes.as_ptr().cast());
        }
    }

    #[unsafe(no_mangle)]
    extern "C" fn stop_at_fault() -> ! {
        Line::new().text("fault").print();
        end(false)
    }

    #[panic_handler]
    fn panic(_: &core::panic::PanicInfo<'_>) -> ! {
        Line::new().text("panic").print();
        end(false)
    }

    macro_rules! marks {
        ($($name:ident $arm:literal $riscv:literal),*) => { $(
            /// An instruction without effect that the counter recognises.
            #[inline(always)]
            pub fn $name() {
                // SAFETY: the instruction changes nothing.
                unsafe {
                    #[cfg(target_arch = "arm")]
                    asm!($arm);
                    #[cfg(target_arch = "riscv32")]
                    asm!(".option push", ".option norvc", $riscv, ".option pop");
                }
            }
        )* };
    }
    marks!(
        start_counting "mov r11, r11" "addi x0, x0, 77",
        stop_counting "mov r10, r10" "addi x0, x0, 78",
        write_count "mov r9, r9" "addi x0, x0, 79"
    );
}

#[cfg(target_os = "none")]
pub use bare::*;

#[cfg(not(target_os = "none"))]
mod hosted {
    use super::Line;

    pub fn end(is_well: bool) -> ! {
        std::process::exit(i32::from(!is_well))
    }
    impl Line {
        pub fn print(self) {
            println!("{}", String::from_utf8_lossy(&self.bytes[..self.length]));
        }
    }
    pub fn start_counting() {}
    pub fn stop_counting() {}
    pub fn write_count() {}
}

#[cfg(not(target_os = "none"))]
pub use hosted::*;
