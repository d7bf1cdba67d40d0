package io.furrow.soak;

/**
 * A result of a job, expected or actual.
 *
 * @param name identifies the result, for instance a field's window
 * @param value content, for instance the average; equal results have equal texts
 * @param time event time from which the result is known, epoch ms
 */
record Result(String name, String value, long time) {}
