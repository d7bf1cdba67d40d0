package io.furrow.launcher;

import java.net.URI;

import picocli.CommandLine.Option;

/** Options that say what is done about alarms. */
final class WatchFlags {
    @Option(
            names = "--webhook",
            paramLabel = "URL",
            description = "Post alarms here, as JSON, again and again until they are taken. Default: nowhere.")
    private URI webhook;

    @Option(
            names = "--silent-after",
            paramLabel = "N",
            defaultValue = "3",
            description =
                    "Periods without a sign of life after which a device counts as silent. Default: ${DEFAULT-VALUE}.")
    private int silentAfter;

    @Option(
            names = "--stop-on-predicted",
            description =
                    "Send Stop to robots that are predicted to meet. This is no safety function: messages may be late or lost.")
    private boolean stops;

    /** @param horizon how far ahead encounters are predicted; null for what suits the other options */
    SuiteSettings.Watch watch(String horizon) {
        String usual = stops ? "10s" : "0s";
        return new SuiteSettings.Watch(webhook, silentAfter, horizon == null ? usual : horizon, stops);
    }
}
