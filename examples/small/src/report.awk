# Joins the errors of the tests with the lines of the guests and the counts of the plugin. Prints JSON, or with `as=tables` the tables
# of docs/small.md.
#
# Lines: "span-error METHOD 5° 15° 30° 60°", "frame-error METHOD TRIANGLES WORST RMS",
# "long METHOD PIXELS SUM …", which is left out here,
# "span METHOD PIXELS ANGLE SUM ARM CYCLES RISCV -", "frame METHOD TRIANGLES PIXELS SUM ARM CYCLES RISCV -".
$1 == "span-error" { errors[$2] = $3 ", " $4 ", " $5 ", " $6; next }
$1 == "frame-error" { worst[$2, $3] = $4; rms[$2, $3] = $5; next }
$1 == "span" {
    if (!($2 in seen)) { seen[$2] = 1; methods[++n] = $2 }
    # 16 spans of each kind.
    scale = 1 / (16 * $3)
    key = $2 SUBSEP $3
    arm[key] += $6 * scale / 4; cycles[key] += $7 * scale / 4; riscv[key] += $8 * scale / 4
    if ($3 == 32 && $4 == 15) {
        aim[$2] = $6 * scale; aim_cycles[$2] = $7 * scale; aim_riscv[$2] = $8 * scale
    }
    next
}
$1 == "frame" {
    frames[++f] = $2 SUBSEP $3
    pixels[$2, $3] = $4; frame_arm[$2, $3] = $6; frame_cycles[$2, $3] = $7; frame_riscv[$2, $3] = $8
    next
}
function three(values, method) {
    return sprintf("%.1f, %.1f, %.1f", values[method, 8], values[method, 32], values[method, 128])
}
function loop(values, method) { return (128 * values[method, 128] - 8 * values[method, 8]) / 120 }
END {
    if (as == "tables") {
        print "| method | M0+ instructions a pixel, n = 8, 32, 128 | cycles, n = 8, 32, 128 | cycles in the loop | RV32IMC instructions, n = 8, 32, 128 | worst error at 5, 15, 30, 60° |"
        print "|---|--:|--:|--:|--:|--:|"
        for (i = 1; i <= n; i++) {
            m = methods[i]
            printf "| `%s` | %s | %s | %.0f | %s | %s |\n", m, three(arm, m), three(cycles, m), loop(cycles, m), three(riscv, m), errors[m]
        }
        print ""
        print "| method | triangles | M0+ instructions | M0+ cycles | frames a second at 133 MHz | RV32IMC instructions | worst error | rms |"
        print "|---|--:|--:|--:|--:|--:|--:|--:|"
        for (i = 1; i <= f; i++) {
            k = frames[i]
            split(k, part, SUBSEP)
            printf "| `%s` | %d | %.2f M | %.2f M | %.0f | %.2f M | %s | %s |\n", part[1], part[2], frame_arm[k] / 1e6, frame_cycles[k] / 1e6, 133e6 / frame_cycles[k], frame_riscv[k] / 1e6, worst[k], rms[k]
        }
        exit
    }
    printf "{\n  \"command\": \"examples/small/run\",\n"
    printf "  \"text\": { \"fast_and_gouraud\": %d, \"all\": %d },\n  \"spans\": [\n", least, all
    for (i = 1; i <= n; i++) {
        m = methods[i]
        printf "    { \"method\": \"%s\", \"m0p_instructions\": [%s], \"m0p_cycles\": [%s], \"m0p_cycles_in_loop\": %.1f, \"rv32_instructions\": [%s], \"at_32_pixels_15_degrees\": [%.1f, %.1f, %.1f], \"worst_error\": [%s] }%s\n", m, three(arm, m), three(cycles, m), loop(cycles, m), three(riscv, m), aim[m], aim_cycles[m], aim_riscv[m], errors[m], i < n ? "," : ""
    }
    print "  ],\n  \"frames\": ["
    for (i = 1; i <= f; i++) {
        k = frames[i]
        split(k, part, SUBSEP)
        printf "    { \"method\": \"%s\", \"triangles\": %d, \"pixels\": %d, \"m0p_instructions\": %d, \"m0p_cycles\": %d, \"rv32_instructions\": %d, \"worst_error\": %s, \"rms_error\": %s }%s\n", part[1], part[2], pixels[k], frame_arm[k], frame_cycles[k], frame_riscv[k], worst[k] == "" ? "null" : worst[k], rms[k] == "" ? "null" : rms[k], i < f ? "," : ""
    }
    print "  ]\n}"
}
