package io.furrow.analytics.temperature;

import java.time.Duration;
import java.util.regex.Pattern;

import picocli.CommandLine.Command;
import picocli.CommandLine.Mixin;
import picocli.CommandLine.Option;

import io.furrow.analytics.field.FieldOptions;
import io.furrow.analytics.job.AnalyticsOptions;
import io.furrow.model.result.AnalyticsKind;

/** The options of the job {@code temperature}. An accessor rejects an invalid value. */
@Command(
        name = "temperature",
        sortOptions = false,
        description =
                "The average temperature of each field in event-time windows. Each device has one vote per window, "
                        + "its median; devices that differ much from the others are excluded and reported as suspects.")
public final class TemperatureOptions extends AnalyticsOptions {
    private static final String TEMPERATURE = "Temperature";
    private static final double TEMPERATURE_FLOOR = 0.5;
    /** A day, by the minute: each window that contains a reading stores it. */
    private static final long MAX_OVERLAP = 1_440;

    private static final Pattern ATTRIBUTE = Pattern.compile("[A-Za-z0-9_:.-]{1,40}");

    @Mixin
    private final FieldOptions fields = new FieldOptions();

    @Option(
            names = "--attribute",
            paramLabel = "NAME",
            defaultValue = TEMPERATURE,
            description =
                    "Numeric attribute that is averaged. Results are named after it: of soilMoisture the average is "
                            + "averageSoilMoisture of an Analytics:FieldSoilMoisture, the job and its group "
                            + "temperature-soilMoisture. Default: ${DEFAULT-VALUE}.")
    private String attribute;

    @Option(
            names = "--window",
            paramLabel = "DURATION",
            defaultValue = "1min",
            description =
                    "Length of a window. Longer: more readings per device, fewer results. Default: ${DEFAULT-VALUE}.")
    private Duration window;

    @Option(
            names = "--slide",
            paramLabel = "DURATION",
            description =
                    "Time from the start of a window to the start of the next, a whole part of --window. Default: "
                            + "--window, so that windows do not overlap.")
    private Duration slide;

    @Option(
            names = "--allowed-lateness",
            paramLabel = "DURATION",
            defaultValue = "0s",
            description =
                    "How long a window accepts late readings after its end; each of them emits the corrected result "
                            + "again. Later readings go to --late-output. Default: ${DEFAULT-VALUE}.")
    private Duration allowedLateness;

    @Option(
            names = "--suspect-floor",
            paramLabel = "NUMBER",
            description =
                    "Standard deviation of the difference between two sound devices in one place, in the attribute's "
                            + "unit. A device within 2.4 times that of the others is never excluded. Raise it if sound devices "
                            + "become suspects, for instance in wide fields. 0: only the spread of the other devices counts, and "
                            + "sound devices often become suspects. Default: " + TEMPERATURE_FLOOR
                            + " (degrees Celsius) for " + TEMPERATURE + "; must be given for any other attribute.")
    private Double suspectFloor;

    @Option(
            names = "--repeat-window",
            paramLabel = "DURATION",
            description = "How long event ids are stored, so that a duplicate is dropped. Default: --window plus "
                    + "--allowed-lateness: a later duplicate is late.")
    private Duration repeatWindow;

    public TemperatureOptions() {
        super(AnalyticsKind.TEMPERATURE);
    }

    FieldOptions fields() {
        return fields;
    }

    /** Jobs of two attributes must share neither a consumer group nor transactions. */
    @Override
    protected String defaultName() { // in transactional ids a colon ends the name
        return attribute().equals(TEMPERATURE)
                ? super.defaultName()
                : super.defaultName() + "-" + attribute().replace(':', '.');
    }

    String attribute() {
        if (!ATTRIBUTE.matcher(attribute).matches()) {
            throw refused(
                    "--attribute must be 1 to 40 of A-Z a-z 0-9 _ - : ., because it becomes part of entity ids", null);
        }
        return attribute;
    }

    Duration window() {
        return positive("--window", window);
    }

    Duration slide() {
        Duration step = slide == null ? window() : positive("--slide", slide);
        if (window().toMillis() % step.toMillis() != 0) {
            throw refused("--slide must be a whole part of --window, for instance 1min of 5min", null);
        }
        if (window().toMillis() / step.toMillis() > MAX_OVERLAP) {
            throw refused(
                    "--slide puts each reading into more than " + MAX_OVERLAP + " windows; write a longer one", null);
        }
        return step;
    }

    Duration allowedLateness() {
        return allowedLateness;
    }

    /** By how much two sound devices differ, in the attribute's unit; has a default for temperatures only. */
    double suspectFloor() {
        if (suspectFloor == null && !attribute().equals(TEMPERATURE)) {
            throw refused(
                    "--attribute " + attribute() + " needs --suspect-floor: by how much two sound devices in one place"
                            + " differ, in its unit, for instance their resolution; 0 to judge by what the others show alone",
                    null);
        }
        double floor = suspectFloor == null ? TEMPERATURE_FLOOR : suspectFloor;
        if (!Double.isFinite(floor) || floor < 0) {
            throw refused("--suspect-floor must be 0 or a positive number", null);
        }
        return floor;
    }

    Duration repeatWindow() {
        return repeatWindow == null ? window().plus(allowedLateness) : positive("--repeat-window", repeatWindow);
    }

    private Duration positive(String option, Duration value) {
        if (value.isZero()) {
            throw refused(option + " must be longer than 0, for instance 1min", null);
        }
        return value;
    }
}
