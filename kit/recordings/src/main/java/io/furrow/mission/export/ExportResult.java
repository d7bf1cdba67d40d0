package io.furrow.mission.export;

import java.util.Optional;

/**
 * What became of a recording.
 *
 * @param events that were written
 * @param leftOut records that hold no event, and events and markers that the format cannot hold
 * @param example which record was left out first, and why
 */
public record ExportResult(long events, long leftOut, Optional<String> example) {}
