package io.furrow.cli.control;

/** Times and speeds of a command line as requests have them; the control plane refuses what is neither. */
final class ReplayArguments {
    static final String TIME = "ISO 8601 or epoch ms.";

    private ReplayArguments() {}

    /** A number where it is epoch ms; null for none. */
    static Object time(String time) {
        return time != null && time.matches("[0-9]{1,15}") ? Long.valueOf(time) : time;
    }

    /** A number where it is one. */
    static Object speed(String speed) {
        try {
            return Double.valueOf(speed);
        } catch (NumberFormatException e) {
            return speed;
        }
    }
}
