package io.furrow.cli.compare;

import io.furrow.model.topic.Topics;

/** What analytics finds: the topic of the live results, and what one result is called. */
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

    /** Topic of the live results; of those of a replay {@link Topics#resultOf}. */
    String liveTopic() {
        return liveTopic;
    }

    /** As tables and JSON have it, for instance {@code encounters}. */
    String code() {
        return code;
    }
}
