package io.furrow.connect;

import org.apache.kafka.common.config.Config;
import org.apache.kafka.common.config.ConfigException;
import org.apache.kafka.common.config.ConfigValue;

/** Puts what is wrong with several options together beside the option that should be changed. */
public final class CheckedTogether {
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

    /** The class does not keep the name by itself. */
    private static ConfigValue optionOf(ConfigException wrong, Config each) {
        String message = wrong.getMessage() + ":";
        return each.configValues().stream()
                .filter(value -> message.contains(" for configuration " + value.name() + ":"))
                .findFirst()
                .orElseThrow(() -> wrong);
    }
}
