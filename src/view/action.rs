//! Keys, and what they ask for.

use std::f64::consts::PI;

/// Something that a key asks for.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Action {
    /// Show the method of this number, from 0, on the side of the pointer; or on the other side.
    Method {
        /// The number in the list of methods.
        number: usize,
        /// True for the side where the pointer is not.
        other: bool,
    },
    /// Turn the camera by azimuth and elevation, in radians.
    Turn(f64, f64),
    /// Show everything so many times as large.
    Zoom(f64),
    /// Move the divider by a part of the width.
    Divide(f64),
    /// Exchange left and right.
    Swap,
    /// Show both methods, then only the left one, then only the right one.
    ShowNext,
    /// Let the lights turn with the eye, or stay in the world.
    CarryLights,
    /// Return to the scene's own camera.
    Reset,
    /// Close the window.
    Close,
}

/// The angle of an arrow key: 24 of them are half a turn.
const STEP: f64 = PI / 24.0;

impl Action {
    /// The keys, for who starts the program.
    pub const KEYS: &str = "drag or arrows turn, wheel or +/- zoom, drag the line or Shift+arrows move it; Space shows one, Tab swaps, \
                            L carries lights along, Home resets, Esc closes";

    /// Returns what the key at a place of the keyboard asks for. Places have the names that UI Events gives them (`KeyboardEvent.code`,
    /// <https://www.w3.org/TR/uievents-code/>), which do not depend on the layout: digits are reached with Shift on some.
    pub fn of_key(code: &str, shift: bool) -> Option<Action> {
        let digit = code
            .strip_prefix("Digit")
            .or_else(|| code.strip_prefix("Numpad"));
        if let Some(digit @ 1..=9) = digit.and_then(|digit| digit.parse().ok()) {
            let number = digit - 1;
            return Some(Action::Method {
                number,
                other: shift,
            });
        }
        Some(match code {
            "ArrowLeft" if shift => Action::Divide(-0.05),
            "ArrowRight" if shift => Action::Divide(0.05),
            "ArrowLeft" => Action::Turn(-STEP, 0.0),
            "ArrowRight" => Action::Turn(STEP, 0.0),
            "ArrowUp" => Action::Turn(0.0, STEP),
            "ArrowDown" => Action::Turn(0.0, -STEP),
            "Equal" | "NumpadAdd" => Action::Zoom(1.1),
            "Minus" | "NumpadSubtract" => Action::Zoom(1.0 / 1.1),
            "Space" => Action::ShowNext,
            "Tab" => Action::Swap,
            "KeyL" => Action::CarryLights,
            "Home" | "KeyR" => Action::Reset,
            "Escape" | "KeyQ" => Action::Close,
            _ => return None,
        })
    }

    /// True if a key that is held does it again and again.
    pub fn repeats(self) -> bool {
        matches!(self, Action::Turn(..) | Action::Zoom(_) | Action::Divide(_))
    }
}

#[cfg(test)]
mod tests {
    use super::Action;

    #[test]
    fn digits_choose_methods_in_order_on_both_blocks_of_the_keyboard() {
        for number in 0..9 {
            for block in ["Digit", "Numpad"] {
                for other in [false, true] {
                    let key = Action::of_key(&std::format!("{block}{}", number + 1), other);
                    assert_eq!(key, Some(Action::Method { number, other }));
                }
            }
        }
        for code in ["Digit0", "Numpad0", "NumpadEnter", "Digit10", "KeyA", ""] {
            assert_eq!(Action::of_key(code, false), None, "{code}");
        }
    }

    #[test]
    fn opposite_keys_undo_each_other() {
        let key = |code| Action::of_key(code, false).expect("a key");
        assert_eq!(key("ArrowLeft"), Action::Turn(-super::STEP, 0.0));
        assert_eq!(key("ArrowRight"), Action::Turn(super::STEP, 0.0));
        assert_eq!(key("NumpadAdd"), key("Equal"));
        let (Action::Zoom(nearer), Action::Zoom(farther)) = (key("Equal"), key("Minus")) else {
            panic!("they zoom");
        };
        // One rounding of a quotient, one of a product.
        assert!((nearer * farther - 1.0).abs() < 4.0 * f64::EPSILON);
        assert_eq!(
            Action::of_key("ArrowLeft", true),
            Some(Action::Divide(-0.05))
        );
    }
}
