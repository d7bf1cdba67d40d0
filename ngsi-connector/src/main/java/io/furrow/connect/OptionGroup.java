package io.furrow.connect;

import java.util.List;
import java.util.Map;
import java.util.function.Predicate;

import org.apache.kafka.common.config.ConfigDef;
import org.apache.kafka.common.config.ConfigDef.Importance;
import org.apache.kafka.common.config.ConfigDef.Recommender;
import org.apache.kafka.common.config.ConfigDef.Type;
import org.apache.kafka.common.config.ConfigDef.Validator;
import org.apache.kafka.common.config.ConfigDef.Width;

/**
 * Declares the options of a group in their order on the page.
 *
 * @param options receives the declarations
 * @param name of the group
 * @param importance of the next options
 * @param visibility of the next options, and the values that user interfaces recommend
 */
public record OptionGroup(ConfigDef options, String name, Importance importance, Visibility visibility) {
    /** A group of options of medium importance that are always visible. */
    public OptionGroup(ConfigDef options, String name) {
        this(options, name, Importance.MEDIUM, new Visibility(List.of(), null, any -> true));
    }

    public OptionGroup high() {
        return new OptionGroup(options, name, Importance.HIGH, visibility);
    }

    public OptionGroup low() {
        return new OptionGroup(options, name, Importance.LOW, visibility);
    }

    /** Shows the options only if another option has such a value, as text; empty stands for a missing value. */
    public OptionGroup shownIf(String option, Predicate<String> value) {
        return new OptionGroup(options, name, importance, new Visibility(visibility.values, option, value));
    }

    /** Recommends values; others may be valid too. */
    public OptionGroup recommending(Object... values) {
        return new OptionGroup(
                options, name, importance, new Visibility(List.of(values), visibility.decidedBy, visibility.shown));
    }

    public void flag(String option, boolean value, String label, String help) {
        recommending(true, false).define(option, Type.BOOLEAN, value, Validators.truth(), Width.SHORT, label, help);
    }

    /** @param value null if there is no default value, {@link ConfigDef#NO_DEFAULT_VALUE} if the option is required */
    public void text(String option, Object value, Validator valid, String label, String help) {
        define(option, Type.STRING, value, valid, Width.LONG, label, help);
    }

    /** The first value is the default. */
    public void choice(String option, List<String> values, String label, String help) {
        Validator valid = ConfigDef.ValidString.in(values.toArray(String[]::new));
        recommending(values.toArray()).define(option, Type.STRING, values.get(0), valid, Width.MEDIUM, label, help);
    }

    /** @param value separated by commas */
    public void list(String option, String value, Validator valid, String label, String help) {
        define(option, Type.LIST, value, valid, Width.LONG, label, help);
    }

    public void secret(String option, String value, Validator valid, String label, String help) {
        define(option, Type.PASSWORD, value, valid, Width.LONG, label, help);
    }

    public void number(String option, long value, Validator valid, String label, String help) {
        define(option, Type.LONG, value, valid, Width.SHORT, label, help);
    }

    public void integer(String option, int value, Validator valid, String label, String help) {
        define(option, Type.INT, value, valid, Width.SHORT, label, help);
    }

    private void define(
            String option, Type type, Object value, Validator valid, Width width, String label, String help) {
        int order = options.configKeys().size() + 1;
        options.define(option, type, value, valid, importance, help, name, order, width, label, visibility);
    }

    private record Visibility(List<Object> values, String decidedBy, Predicate<String> shown) implements Recommender {
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
