package io.furrow.cli.control;

/** Converts times and speeds of a command line for requests; the control plane rejects invalid ones. */
final class ReplayArguments {
    static final String TIME = "ISO 8601 or epoch ms.";

    private ReplayArguments() {}

    /** A number if it is epoch ms; null if absent. */
    static Object time(String time) {
        return time != null && time.matches("[0-9]{1,15}") ? Long.valueOf(time) : time;
    }

    /** A number if it can be parsed as one. */
    static Object speed(String speed) {
        try {
            return Double.valueOf(speed);
        } catch (NumberFormatException e) {
            return speed;
        }
    }
}
