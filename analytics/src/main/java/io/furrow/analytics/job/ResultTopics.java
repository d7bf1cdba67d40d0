package io.furrow.analytics.job;

import picocli.CommandLine.Option;

import io.furrow.model.topic.Topics;

/** Options for the topics that a job writes to; the initial values are their defaults. */
final class ResultTopics {
    @Option(names = "--output", paramLabel = "TOPIC", description = "Topic of the results. Default: ${DEFAULT-VALUE}.")
    String output;

    @Option(
            names = "--late-output",
            paramLabel = "TOPIC",
            description = "Topic of the events that arrived too late to count. Default: ${DEFAULT-VALUE}.")
    String lateOutput;

    @Option(
            names = "--clock-output",
            paramLabel = "TOPIC",
            defaultValue = Topics.CLOCKS,
            description =
                    "Topic of clock reports: devices whose reports are late again and again, and clock offsets. Default: "
                            + "${DEFAULT-VALUE}.")
    String clockOutput;

    ResultTopics(String output, String lateOutput) {
        this.output = output;
        this.lateOutput = lateOutput;
    }
}
