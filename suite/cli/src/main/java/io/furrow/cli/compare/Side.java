package io.furrow.cli.compare;

import java.util.Collection;
import java.util.List;
import java.util.regex.Pattern;

import io.furrow.cli.option.CommandException;
import io.furrow.model.topic.Topics;

/**
 * One side of a comparison: a replay, or the live results.
 *
 * @param name for tables
 * @param topic of the replay; null of live results
 */
record Side(String name, String topic) {
    static final String LIVE = "live";

    private static final Pattern NAME = Pattern.compile("([A-Za-z0-9_-]{1,64})\\.([0-9a-f]{8})");

    /**
     * @param code {@code live}, a replay's name, or a replay's topic
     * @param topics existing topics: a replay's topic need not be named after its mission
     * @throws CommandException if it is none of these, or the replay has no topic
     */
    static Side of(String code, Collection<String> topics) {
        if (code.equals(LIVE)) {
            return new Side(LIVE, null);
        } else if (Topics.isReplay(code)) {
            return new Side(Topics.replayOf(code).orElseThrow(), required(code, topics));
        } else if (!NAME.matcher(code).matches()) {
            throw new CommandException(
                    "'%s' is not a replay: name one as MISSION.ID, its topic as data.MISSION.replay.ID, or say live."
                            .formatted(code));
        }
        int dot = code.indexOf('.');
        String named = Topics.replay(code.substring(0, dot), code.substring(dot + 1));
        if (hasAnyOf(named, topics)) {
            return new Side(code, named);
        }
        return new Side(code, required(named, topics));
    }

    private static String required(String topic, Collection<String> topics) {
        if (!hasAnyOf(topic, topics)) {
            throw new CommandException(
                    "There is no topic %s, and none of its results: check the name with ./furrow replay list. One that is played on a topic of another name is named by it."
                            .formatted(topic));
        }
        return topic;
    }

    /** The replay's topic may be deleted before those of its results. */
    private static boolean hasAnyOf(String topic, Collection<String> topics) {
        Side side = new Side(topic, topic);
        return topics.contains(topic)
                || List.of(ResultKind.values()).stream().anyMatch(kind -> topics.contains(side.results(kind)));
    }

    boolean isLive() {
        return topic == null;
    }

    /** The topic of its results. */
    String results(ResultKind kind) {
        return isLive() ? kind.liveTopic() : Topics.resultOf(topic, kind.liveTopic());
    }

    /** The mission at the beginning of a replay's name; null of live results. */
    String mission() {
        return isLive() ? null : name.substring(0, name.lastIndexOf('.'));
    }
}
