package io.furrow.soak;

/**
 * One result that a job must come to, or has come to.
 *
 * @param name what there is one of, for instance a field's window
 * @param value what it says, for instance the average; equal text is equal
 * @param time event time from which it is known, epoch ms
 */
record Result(String name, String value, long time) {}
