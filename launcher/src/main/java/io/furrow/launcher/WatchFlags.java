package io.furrow.launcher;

import java.net.URI;

import picocli.CommandLine.Option;

/** Options of {@code demo} and {@code up} that say what is done about alarms. */
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

    @Option(
            names = "--predict",
            paramLabel = "DURATION",
            description =
                    "How far ahead encounters are predicted, 0s for none. Default: 10s with --stop-on-predicted, else 0s.")
    private String horizon;

    SuiteSettings.Watch watch() {
        String usual = stops ? "10s" : "0s";
        return new SuiteSettings.Watch(webhook, silentAfter, horizon == null ? usual : horizon, stops);
    }
}
