package io.furrow.connect.source;

import java.util.List;

import org.apache.kafka.common.config.ConfigDef;
import org.apache.kafka.common.config.ConfigDef.Importance;
import org.apache.kafka.common.config.ConfigDef.Type;
import org.apache.kafka.common.config.ConfigDef.Width;

import io.furrow.connect.Recommendations;
import io.furrow.connect.broker.BrokerOptions;

/** Declares a group of options that only count where a context broker is named, in the order in which it is asked to. */
final class OptionGroup {
    private final ConfigDef options;
    private final String name;
    private int order;

    OptionGroup(ConfigDef options, String name) {
        this.options = options;
        this.name = name;
    }

    void flag(String option, boolean value, String label, String help) {
        ConfigDef.Validator any = ConfigDef.LambdaValidator.with((name, given) -> {}, () -> "true or false");
        options.define(
                option, Type.BOOLEAN, value, any, Importance.MEDIUM, help, name, ++order, Width.SHORT, label, shown());
    }

    void text(String option, String value, ConfigDef.Validator valid, String label, String help) {
        options.define(
                option, Type.STRING, value, valid, Importance.MEDIUM, help, name, ++order, Width.LONG, label, shown());
    }

    /** The first value is the default. */
    void choice(String option, List<String> values, String label, String help) {
        options.define(
                option,
                Type.STRING,
                values.get(0),
                ConfigDef.ValidString.in(values.toArray(String[]::new)),
                Importance.LOW,
                help,
                name,
                ++order,
                Width.MEDIUM,
                label,
                shown(values.toArray()));
    }

    void list(String option, String value, ConfigDef.Validator valid, String label, String help) {
        options.define(
                option, Type.LIST, value, valid, Importance.MEDIUM, help, name, ++order, Width.LONG, label, shown());
    }

    void number(String option, long value, ConfigDef.Range valid, String label, String help) {
        options.define(
                option, Type.LONG, value, valid, Importance.LOW, help, name, ++order, Width.SHORT, label, shown());
    }

    private static ConfigDef.Recommender shown(Object... values) {
        return Recommendations.shownIf(BrokerOptions.URL, url -> !url.isEmpty(), values);
    }
}
