package io.furrow.mission;

import java.util.Map;

import com.fasterxml.jackson.databind.node.ObjectNode;

/**
 * An event of a mission as it is kept, in a document or in a line of an archive.
 *
 * @param id event id
 * @param time event time, epoch ms
 * @param entityId also if there is no entity
 * @param headers of the record, hop stamps among them, without the id, the time and the version of the envelope, which say
 *     nothing more
 * @param entity in normalized form; null if the event is the entity's deletion
 */
public record StoredEvent(String id, long time, String entityId, Map<String, String> headers, ObjectNode entity) {}
