package io.furrow.control.mission;

import java.util.function.Predicate;

import io.furrow.control.manager.Quota;
import io.furrow.control.manager.Sequence;

/**
 * What missions share with domains.
 *
 * @param isDomain whether there is a domain of a name
 * @param sequence of all that is requested
 * @param quota room for all definitions
 */
record SharedStores(Predicate<String> isDomain, Sequence sequence, Quota quota) {}
