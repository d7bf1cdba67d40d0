package io.furrow.model.result;

import java.util.Locale;

/**
 * Names of entities on {@code data.temperature}: the robust average of an attribute per field and window, and devices
 * with suspect values. The average of {@code temperature} has the type {@code Analytics:FieldTemperature} and the
 * attribute {@code averageTemperature}.
 */
public final class FieldResult {
    /** Prefix of types, followed by the capitalized name of the attribute. */
    public static final String TYPE_PREFIX = ResultTypes.PREFIX + "Field";

    public static final String TEMPERATURE_TYPE = TYPE_PREFIX + "Temperature";

    /** Id of the field. */
    public static final String FIELD = "field";
    /** Number of devices that reported in the window. */
    public static final String DEVICES = "devices";
    /** Ids of the devices whose values were excluded. */
    public static final String SUSPECTS = "suspects";
    /** Types of the entities of {@link #SUSPECTS}, in their order; empty if unknown. */
    public static final String SUSPECT_TYPES = "suspectTypes";
    /** Epoch ms, inclusive. */
    public static final String WINDOW_START = "windowStart";
    /** Epoch ms, exclusive. */
    public static final String WINDOW_END = "windowEnd";
    /** {@link #ROBUST} or {@link #UNVERIFIED}. */
    public static final String QUALITY = "quality";

    public static final String ROBUST = "robust";
    /** Too few devices to determine which are suspect. */
    public static final String UNVERIFIED = "unverified";

    public static final String AVERAGE_TEMPERATURE = average("Temperature");

    private FieldResult() {}

    /** @param attribute as devices report it, for instance {@code temperature} */
    public static String title(String attribute) {
        return attribute.substring(0, 1).toUpperCase(Locale.ROOT) + attribute.substring(1);
    }

    /** @param title result of {@link #title(String)} */
    public static String average(String title) {
        return "average" + title;
    }
}
