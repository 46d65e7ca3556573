// What is where in a journal's file: JOURNAL.md, IF-JR-11 to IF-JR-15.
#pragma once

namespace berm::record::names {

constexpr const char* kCycleTopic = "/kernel/cycle";
constexpr const char* kCycleEncoding = "berm_journal_cycle";
constexpr const char* kDecisionTopic = "/kernel/decision";
constexpr const char* kLostTopic = "/journal/lost";
constexpr const char* kParameters = "kernel.params";
constexpr const char* kStart = "berm_start";
constexpr const char* kEnd = "berm_end";

}  // namespace berm::record::names
