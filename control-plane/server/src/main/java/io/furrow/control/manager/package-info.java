/** Provides the foundation of managers: deduplicated requests, answers, atomic writes, stores and topologies. */
package io.furrow.control.manager;
