package io.furrow.analytics.job;

import picocli.CommandLine.Option;

/** Options for the topics that a job writes to; the initial values are their defaults. */
final class ResultTopics {
    @Option(names = "--output", paramLabel = "TOPIC", description = "Topic of the results. Default: ${DEFAULT-VALUE}.")
    String output;

    @Option(
            names = "--late-output",
            paramLabel = "TOPIC",
            description = "Topic of the events that arrived too late to count. Default: ${DEFAULT-VALUE}.")
    String lateOutput;

    ResultTopics(String output, String lateOutput) {
        this.output = output;
        this.lateOutput = lateOutput;
    }
}
