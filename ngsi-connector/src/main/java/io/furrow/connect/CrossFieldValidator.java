package io.furrow.connect;

import java.util.regex.Matcher;
import java.util.regex.Pattern;

import org.apache.kafka.common.config.Config;
import org.apache.kafka.common.config.ConfigException;
import org.apache.kafka.common.config.ConfigValue;

/** Validates several options together and attaches each error to the option that should be changed. */
public final class CrossFieldValidator {
    private static final Pattern NAMED = Pattern.compile(" for configuration ([^\\s:]+):");

    private CrossFieldValidator() {}

    /**
     * Adds the errors of a joint validation to those of the single options.
     *
     * @param reading throws {@link ConfigException}, whose message names the option in the format of that class
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

    /** The exception has no field for the name. An option of the worker, such as a converter, gets its value here. */
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
