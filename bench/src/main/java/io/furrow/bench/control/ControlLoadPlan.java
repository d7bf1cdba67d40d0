package io.furrow.bench.control;

import java.time.Duration;

/**
 * Requests to the managers.
 *
 * @param rate requests per second that are due whether or not earlier ones were answered; 0 for the next as soon as one is
 * @param outstanding how many may wait for their answer at a time
 */
public record ControlLoadPlan(int rate, int outstanding, Duration duration) {}
