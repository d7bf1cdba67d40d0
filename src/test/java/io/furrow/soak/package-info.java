/** Long runs from outside: what writes numbered events, and what says which results must come of them. */
package io.furrow.soak;
