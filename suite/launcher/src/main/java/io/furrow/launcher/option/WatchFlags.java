package io.furrow.launcher.option;

import java.io.IOException;
import java.net.URI;
import java.nio.file.Path;

import picocli.CommandLine.Option;

import io.furrow.cli.option.CommandException;
import io.furrow.cli.option.HttpUriConverter;
import io.furrow.control.alarm.action.Webhook;
import io.furrow.control.health.HealthOptions;
import io.furrow.launcher.suite.SuiteSettings;

/** Options for alarms and the reactions to them. */
public final class WatchFlags {
    private static final double PERCENT = 100;

    @Option(
            names = "--webhook",
            paramLabel = "URL",
            converter = HttpUriConverter.class,
            description = "URL to which alarms are posted as JSON, retried until accepted. Default: none.")
    private URI webhook;

    @Option(
            names = "--webhook-secret",
            paramLabel = "FILE",
            description =
                    "File with the secret, at least 16 bytes, that signs posts; two lines sign twice, for a rotation. "
                            + "Read again when it changes. Default: no signature.")
    private Path webhookSecret;

    @Option(
            names = "--silent-after",
            paramLabel = "N",
            description =
                    "Number of periods without a report after which a device counts as silent. Default: ${DEFAULT-VALUE}.")
    private int silentAfter = 3;

    @Option(
            names = "--silent-share",
            paramLabel = "PERCENT",
            defaultValue = "50",
            description =
                    "Percentage of a mission's devices, at least three, whose silence is one alarm of the mission. Default: ${DEFAULT-VALUE}.")
    private double silentShare;

    @Option(
            names = "--stop-on-predicted",
            description =
                    "Send Stop to robots that are predicted to meet. This is not a safety function: messages may be late or lost.")
    private boolean stops;

    /**
     * @param horizon how far ahead encounters are predicted; null to derive it from the other options
     * @throws CommandException if options contradict each other or the secret cannot be used
     */
    public SuiteSettings.Watch watch(String horizon) {
        String usual = stops ? "10s" : "0s";
        return new SuiteSettings.Watch(settings(), health(), horizon == null ? usual : horizon, stops);
    }

    private Webhook.Settings settings() {
        if (webhook == null) {
            if (webhookSecret != null) {
                throw new CommandException("--webhook-secret signs what --webhook posts: name that too.");
            }
            return null;
        }
        Webhook.Settings settings = Webhook.Settings.of(webhook);
        if (webhookSecret == null) {
            return settings;
        }
        try {
            return settings.signedWith(webhookSecret).checked();
        } catch (IOException e) {
            throw new CommandException("--webhook-secret: " + e.getMessage(), e);
        }
    }

    private HealthOptions health() {
        if (silentAfter < 1 || !(silentShare > 0 && silentShare <= PERCENT)) {
            throw new CommandException(
                    "--silent-after is at least 1, and --silent-share above 0 and at most 100; they are %d and %s."
                            .formatted(silentAfter, silentShare));
        }
        return new HealthOptions(silentAfter, HealthOptions.DEFAULT.period(), silentShare / PERCENT);
    }
}
