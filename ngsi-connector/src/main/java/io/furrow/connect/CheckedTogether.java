package io.furrow.connect;

import java.util.regex.Matcher;
import java.util.regex.Pattern;

import org.apache.kafka.common.config.Config;
import org.apache.kafka.common.config.ConfigException;
import org.apache.kafka.common.config.ConfigValue;

/** Puts what is wrong with several options together beside the option that should be changed. */
public final class CheckedTogether {
    private static final Pattern NAMED = Pattern.compile(" for configuration ([^\\s:]+):");

    private CheckedTogether() {}

    /**
     * Adds what a reading of all options says, where each option for itself is right.
     *
     * @param reading throws {@link ConfigException}, whose message names the option as that class does
     */
    public static Config with(Config each, Runnable reading) {
        if (each.configValues().stream()
                .anyMatch(value -> !value.errorMessages().isEmpty())) {
            return each;
        }
        try {
            reading.run();
        } catch (ConfigException e) {
            optionOf(e, each).addErrorMessage(e.getMessage());
        }
        return each;
    }

    /** The class does not keep the name by itself. An option of the worker's, such as a converter, gets its value here. */
    private static ConfigValue optionOf(ConfigException wrong, Config each) {
        Matcher named = NAMED.matcher(wrong.getMessage() + ":");
        if (!named.find()) {
            throw wrong;
        }
        return each.configValues().stream()
                .filter(value -> value.name().equals(named.group(1)))
                .findFirst()
                .orElseGet(() -> {
                    each.configValues().add(new ConfigValue(named.group(1)));
                    return each.configValues().get(each.configValues().size() - 1);
                });
    }
}
