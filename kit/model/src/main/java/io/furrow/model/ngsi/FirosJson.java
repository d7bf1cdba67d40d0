package io.furrow.model.ngsi;

import java.nio.charset.StandardCharsets;
import java.util.Optional;

import com.fasterxml.jackson.core.json.JsonReadFeature;
import com.fasterxml.jackson.databind.JsonNode;
import com.fasterxml.jackson.databind.ObjectReader;

/**
 * Reads ROS messages as FIROS writes them: JSON with {@code %27} for quotes. Unlike in NGSI, numbers may be {@code NaN}
 * or infinite, which ROS prescribes for values that are not measured.
 */
public final class FirosJson {
    private static final ObjectReader READER =
            NgsiJson.mapper().reader().with(JsonReadFeature.ALLOW_NON_NUMERIC_NUMBERS);
    private static final String QUOTE = "%27";
    private static final String BEGIN = "{" + QUOTE;

    private FirosJson() {}

    public static JsonNode read(String escaped) throws UnreadableException {
        return NgsiJson.read(escaped.replace(QUOTE, "\"").getBytes(StandardCharsets.UTF_8), READER);
    }

    /** Returns the number of a message with one member, such as std_msgs/Float64; empty for other texts. */
    static Optional<Double> number(String text) {
        if (!text.startsWith(BEGIN)) {
            return Optional.empty();
        }
        try {
            JsonNode message = read(text);
            return message.size() == 1 ? Numbers.finite(message.iterator().next()) : Optional.empty();
        } catch (UnreadableException e) {
            return Optional.empty();
        }
    }
}
