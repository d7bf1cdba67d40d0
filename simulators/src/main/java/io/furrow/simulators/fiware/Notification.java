package io.furrow.simulators.fiware;

/**
 * One HTTP request to come.
 *
 * @param correlator value of the header {@code Fiware-Correlator}
 */
record Notification(Subscription subscription, Change change, String correlator) {}
