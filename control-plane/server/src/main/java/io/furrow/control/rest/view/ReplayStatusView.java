package io.furrow.control.rest.view;

import java.util.List;
import java.util.Optional;
import java.util.stream.Stream;

import com.fasterxml.jackson.databind.node.ObjectNode;

import io.furrow.control.rest.access.ProblemException;
import io.furrow.model.control.ErrorCode;
import io.furrow.model.topic.Topics;

/** Reads desired replays, each with the status reported by its player as member {@code status}. */
public record ReplayStatusView(StateView view) {
    public static final String REPLAY = "replay";
    public static final String GROUP = "group";

    /** Returns all replays in the order of their names. @throws ProblemException if the topics were not read yet */
    public Stream<ObjectNode> all() {
        return view.all(Topics.REPLAYS).map(this::withStatus);
    }

    Optional<ObjectNode> find(String replay) {
        return view.find(Topics.REPLAYS, replay).map(this::withStatus);
    }

    /** @throws ProblemException if there is none */
    public ObjectNode get(String replay) {
        return find(replay)
                .orElseThrow(() -> new ProblemException(
                        ErrorCode.UNKNOWN_REPLAY, "there is no replay '%s', or it is over".formatted(replay)));
    }

    /** Returns the members of a group. @throws ProblemException if there is none */
    public List<ObjectNode> group(String group) {
        List<ObjectNode> members =
                all().filter(each -> group.equals(each.path(GROUP).textValue())).toList();
        if (members.isEmpty()) {
            throw new ProblemException(
                    ErrorCode.UNKNOWN_REPLAY, "there is no group '%s', or it is over".formatted(group));
        }
        return members;
    }

    /** Returns the last status reported by its player. */
    Optional<ObjectNode> status(String replay) {
        return view.find(Topics.REPLAYS_STATUS, replay);
    }

    ObjectNode withStatus(ObjectNode desired) {
        status(desired.path(REPLAY).asText()).ifPresent(status -> desired.set("status", status));
        return desired;
    }
}
