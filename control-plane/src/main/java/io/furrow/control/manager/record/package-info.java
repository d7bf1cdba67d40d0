/** Records of the managers: their position in the source topic, deduplication, state stores, dead letters. */
package io.furrow.control.manager.record;
