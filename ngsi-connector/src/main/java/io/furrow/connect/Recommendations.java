package io.furrow.connect;

import java.util.List;
import java.util.Map;
import java.util.function.Predicate;

import org.apache.kafka.common.config.ConfigDef.Recommender;

/** What a user interface offers for an option, and whether it shows it. */
public final class Recommendations {
    private Recommendations() {}

    /** Always shown, with these values to choose from; others may be valid too. */
    public static Recommender values(Object... values) {
        return new Offer(List.of(values), null, any -> true);
    }

    /** Shown where another option has such a value, as text; empty counts for one without a value. */
    public static Recommender shownIf(String option, Predicate<String> value, Object... values) {
        return new Offer(List.of(values), option, value);
    }

    private record Offer(List<Object> values, String decidedBy, Predicate<String> shown) implements Recommender {
        @Override
        public List<Object> validValues(String name, Map<String, Object> config) {
            return values;
        }

        @Override
        public boolean visible(String name, Map<String, Object> config) {
            Object value = decidedBy == null ? "" : config.get(decidedBy);
            return shown.test(value == null ? "" : value.toString());
        }
    }
}
