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

    /** Shows the options only if another option has such a value, as text; a missing value counts as empty. */
    public OptionGroup shownIf(String option, Predicate<String> value) {
        return new OptionGroup(options, name, importance, new Visibility(visibility.values, option, value));
    }

    /** Recommends values; others may be valid too. */
    public OptionGroup recommending(Object... values) {
        return new OptionGroup(
                options, name, importance, new Visibility(List.of(values), visibility.decidedBy, visibility.shown));
    }

    public Option flag(String option, boolean value, String label) {
        Validator valid = Validators.any("true or false");
        return recommending(true, false).option(option, Type.BOOLEAN, value, valid, Width.SHORT, label);
    }

    /** @param value null if there is no default value, {@link ConfigDef#NO_DEFAULT_VALUE} if the option is required */
    public Option text(String option, Object value, Validator valid, String label) {
        return option(option, Type.STRING, value, valid, Width.LONG, label);
    }

    /** The first value is the default. */
    public Option choice(String option, List<String> values, String label) {
        Validator valid = ConfigDef.ValidString.in(values.toArray(String[]::new));
        return recommending(values.toArray()).option(option, Type.STRING, values.get(0), valid, Width.MEDIUM, label);
    }

    /** @param value separated by commas */
    public Option list(String option, String value, Validator valid, String label) {
        return option(option, Type.LIST, value, valid, Width.LONG, label);
    }

    public Option secret(String option, String value, Validator valid, String label) {
        return option(option, Type.PASSWORD, value, valid, Width.LONG, label);
    }

    public Option number(String option, long value, Validator valid, String label) {
        return option(option, Type.LONG, value, valid, Width.SHORT, label);
    }

    public Option integer(String option, int value, Validator valid, String label) {
        return option(option, Type.INT, value, valid, Width.SHORT, label);
    }

    private Option option(String option, Type type, Object value, Validator valid, Width width, String label) {
        int order = options.configKeys().size() + 1;
        return help ->
                options.define(option, type, value, valid, importance, help, name, order, width, label, visibility);
    }

    /** An option that is declared once it has its description. */
    @FunctionalInterface
    public interface Option {
        void help(String description);
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
