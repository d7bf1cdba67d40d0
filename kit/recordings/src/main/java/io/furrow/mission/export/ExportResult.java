package io.furrow.mission.export;

import java.util.Optional;

/**
 * The result of an export.
 *
 * @param events number of written events
 * @param leftOut number of skipped records: invalid events, and events and markers that the format cannot express
 * @param example the first skipped record, and why
 */
public record ExportResult(long events, long leftOut, Optional<String> example) {}
