package io.furrow.mission.marker;

import com.fasterxml.jackson.databind.node.ObjectNode;

import io.furrow.model.ngsi.NgsiJson;

/**
 * A note on a moment of a mission. {@link Markers#add} checks it.
 *
 * @param id unique among all markers
 * @param mission its name
 * @param time event time of the moment, epoch ms
 * @param note for people
 * @param author empty if unknown
 * @param created time of creation, epoch ms
 */
public record Marker(String id, String mission, long time, String note, String author, long created) {
    /** Returns {@code {"id", "mission", "time", "note", "author", "created"}}, with times in epoch ms. */
    public ObjectNode toJson() {
        return NgsiJson.object()
                .put("id", id)
                .put("mission", mission)
                .put("time", time)
                .put("note", note)
                .put("author", author)
                .put("created", created);
    }
}
