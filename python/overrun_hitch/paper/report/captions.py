"""What each figure shows and what to see in it."""

from __future__ import annotations

from collections.abc import Mapping

PAPER: Mapping[str, tuple[str, str]] = {
    "3": (
        "Figure 3: steady deceleration",
        "The more brake torque the trailer makes of the hitch force (r/k), the nearer the deceleration comes to that "
        "of the car alone, ever more slowly. The circles are the FMU's on theory's curve; the squares, cases iv to "
        "ix, stand beside it, because their vehicles are not the datum's: each has the r/k that gives 0.95. Right "
        "axis: the spring that lets the drawbar in by D at 5 m/s2. Cases i, ii and iii have that of 0.05 m.",
    ),
    "4": (
        "Figure 4: root loci of the shunting mode, cases i to iii, k halved, two other speeds",
        "Lines and small marks: theory. Open marks around them: growth rate and frequency measured on FMU runs. What "
        "is right of the boundary shunts by itself. The damper moves the mode far, the other changes hardly move it; "
        "the lower panel shows where each curve crosses the boundary: at 40 m/s with twice the C of 20 m/s.",
    ),
    "5": (
        "Figure 5: root loci of the shunting mode, cases iv to ix",
        "One parameter of case ii at a time, less by 20 %. The curves lie beside each other because each has another "
        "k. Less mass of car (vii) or trailer (viii) damps better; the rest makes little difference.",
    ),
    "6a": (
        "Figure 6a: C = 20 N.s/m, the drawbar a hundred times as stiff in tension",
        "The oscillation grows until the drawbar leaves compression; from then on its tension stop hits back in "
        "every cycle, which the car feels. Theory does not cover it: the frequency is higher.",
    ),
    "6b": (
        "Figure 6b: the same, as stiff in tension as in compression",
        "It grows alike, but the trailer does most of the moving; the car's deceleration varies little.",
    ),
    "7": (
        "Figure 7: C = 100 N.s/m",
        "At this speed almost exactly the damper that neither lets the oscillation grow nor makes it decay.",
    ),
    "8": ("Figure 8: C = 500 N.s/m", "It decays at the rate and with the frequency of linear theory."),
    "9": (
        "Figure 9: C = 100 N.s/m, clearance 0.1 m",
        "The trailer runs through the clearance before its brake acts, arrives with speed, and is thrown back: the "
        "oscillation is slower and larger than in figure 7, and fades slowly.",
    ),
    "10": (
        "Figure 10: C = 500 N.s/m, clearance 0.1 m",
        "The drawbar falls back into the clearance twice; then it stays in compression, and the oscillation decays "
        "as in figure 8.",
    ),
    "11": (
        "Figure 11: C = 2500 N.s/m, clearance 0.1 m",
        "One overshoot, and it is all but over. But the trailer's brake comes later: the damper holds the trailer "
        "back.",
    ),
}

BEYOND: Mapping[str, tuple[str, str]] = {
    "boundary": (
        "C_crit over r/k and speed",
        "With less than C_crit the combination shunts by itself. Everything else is the datum's; k lets the drawbar "
        "in by 1 cm per m/s2, as in cases i, ii and iii. The contours lie at even distances one above the other: "
        "C_crit is in proportion to the speed. To the right they become level: a stronger brake does not ask for "
        "more.",
    ),
    "cycles": (
        "Sustained oscillations of case ii at 40 m/s",
        "Lines: predicted by the describing function, as far as it predicts any. Marks: what the FMU came to after "
        "three minutes, on the axis at 0 where it faded, under an arrow where it ran away. Lines and marks of the "
        "three clearances lie on one another where nothing strikes the tension stop.",
    ),
    "device": (
        "C_crit over r/k, the lag of the trailer's brake and speed",
        "With less than C_crit the combination shunts by itself. To read one's own: up from r/k to the lag. k lets the "
        "drawbar in by 1 cm per m/s2, as in cases i, ii and iii (dotted upright), everything else is the datum's. The "
        "contours lie at even distances one above the other, and at a fourfold speed they are not much lower: C_crit "
        "rises with the lag almost in proportion, whatever the speed. Broad grey: the closed form. Thick: the damper "
        "of figure 8.",
    ),
    "stops": (
        "Case ii from 40 m/s to rest",
        "Above: the compression for C = 20 N.s/m, in the envelope that the growth rate predicts; at rest the trailer's "
        "brake holds the drawbar where it is. Middle: the amplitudes of four stops on a logarithmic scale, every other "
        "extremum of the FMU's. Once the amplitude exceeds the steady compression (the plus signs), the drawbar leaves "
        "compression in every cycle, the trailer's brake lets go, and the shunting grows less than predicted. Below: "
        "by how much amplitudes are more than predicted, as far as theory applies.",
    ),
}
