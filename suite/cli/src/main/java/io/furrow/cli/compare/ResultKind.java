package io.furrow.cli.compare;

import io.furrow.model.topic.Topics;

/** The kinds of analytics results, each with the topic of its live results and its name. */
enum ResultKind {
    ENCOUNTERS(Topics.COLLISION, "encounters"),
    AVERAGES(Topics.TEMPERATURE, "averages"),
    STAYS(Topics.PRESENCE, "stays");

    private final String liveTopic;
    private final String code;

    ResultKind(String liveTopic, String code) {
        this.liveTopic = liveTopic;
        this.code = code;
    }

    /** Topic of the live results; for those of a replay see {@link Topics#resultOf}. */
    String liveTopic() {
        return liveTopic;
    }

    /** The name in tables and JSON, for instance {@code encounters}. */
    String code() {
        return code;
    }
}
