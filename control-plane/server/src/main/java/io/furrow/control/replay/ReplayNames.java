package io.furrow.control.replay;

import java.util.List;
import java.util.UUID;
import java.util.function.Supplier;

import io.furrow.control.manager.Table;
import io.furrow.model.control.DesiredReplay;
import io.furrow.model.control.ErrorCode;
import io.furrow.model.control.RejectedException;
import io.furrow.model.topic.Topics;

/** Generates names and topics for new replays that no other replay uses. */
record ReplayNames(Table<DesiredReplay> replays, Supplier<UUID> ids) {
    private static final int ID_DIGITS = 8;

    /** Returns eight digits that no replay or topic of the missions and no group uses. */
    String newId(List<String> missions) {
        String id;
        do {
            id = ids.get().toString().substring(0, ID_DIGITS);
        } while (isUsed(missions, id));
        return id;
    }

    private boolean isUsed(List<String> missions, String id) {
        return replays.all().stream()
                .anyMatch(each -> id.equals(each.group())
                        || missions.stream()
                                .anyMatch(mission -> each.replay().equals(mission + "." + id)
                                        || each.topic().equals(Topics.replay(mission, id))));
    }

    /** @throws RejectedException if another replay has the name or the topic of a new one */
    void require(DesiredReplay added) throws RejectedException {
        if (replays.contains(added.replay())) {
            throw new RejectedException(
                    ErrorCode.REPLAY_EXISTS,
                    "there is a replay '%s' already; choose a topic of other digits, or stop it first"
                            .formatted(added.replay()));
        }
        List<DesiredReplay> owners = replays.where(each -> each.topic().equals(added.topic()));
        if (!owners.isEmpty()) {
            throw new RejectedException(
                    ErrorCode.REPLAY_EXISTS,
                    "replay '%s' is played on topic '%s'; choose another topic, or stop it first"
                            .formatted(owners.get(0).replay(), added.topic()));
        }
    }
}
