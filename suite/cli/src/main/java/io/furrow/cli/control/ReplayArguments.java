package io.furrow.cli.control;

import java.util.LinkedHashMap;
import java.util.Map;

import picocli.CommandLine.TypeConversionException;

import io.furrow.cli.control.client.ControlOptions;
import io.furrow.cli.time.TimeConverter;

/** Converts arguments of a command line for requests; the control plane rejects invalid speeds. */
final class ReplayArguments {
    private ReplayArguments() {}

    /** Returns a time in epoch ms. */
    static long time(ControlOptions control, String time) {
        try {
            return new TimeConverter().convert(time).toEpochMilli();
        } catch (TypeConversionException e) {
            throw control.refused(e.getMessage());
        }
    }

    /** Returns the members of a range of event times. */
    static Map<String, Long> range(ControlOptions control, String from, String to) {
        Map<String, Long> range = new LinkedHashMap<>();
        range.put("from", time(control, from));
        range.put("to", time(control, to));
        return range;
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
