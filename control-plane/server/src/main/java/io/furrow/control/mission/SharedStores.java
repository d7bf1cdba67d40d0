package io.furrow.control.mission;

import java.util.function.Predicate;

import io.furrow.control.manager.Quota;
import io.furrow.control.manager.Sequence;

/**
 * Stores and limits that missions share with domains.
 *
 * @param isDomain whether there is a domain of a name
 * @param sequence of the desired state
 * @param quota for the size of all definitions
 */
record SharedStores(Predicate<String> isDomain, Sequence sequence, Quota quota) {}
